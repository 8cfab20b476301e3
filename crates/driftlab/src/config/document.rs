//! The config as keys with the places where they stand, before it becomes typed.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Where one key stands and where its value does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Spans {
    pub(super) key: Range<usize>,
    pub(super) value: Range<usize>,
}

/// Tables of which exactly one key is the variant.
pub(super) const VARIANTS: [&str; 3] = ["world", "world3d", "planner"];

/// The table with all its spans moved by `base`.
pub(super) fn moved(table: DeTable<'_>, base: usize) -> DeTable<'_> {
    table
        .into_iter()
        .map(|(key, value)| {
            let key_span = shifted(key.span(), base);
            (Spanned::new(key_span, key.into_inner()), moved_value(value, base))
        })
        .collect()
}

fn moved_value(value: Spanned<DeValue<'_>>, base: usize) -> Spanned<DeValue<'_>> {
    let span = shifted(value.span(), base);
    let value = match value.into_inner() {
        DeValue::Table(table) => DeValue::Table(moved(table, base)),
        DeValue::Array(mut items) => {
            for item in items.iter_mut() {
                let here = std::mem::replace(item, Spanned::new(0..0, DeValue::Boolean(false)));
                *item = moved_value(here, base);
            }
            DeValue::Array(items)
        }
        plain => plain,
    };
    Spanned::new(span, value)
}

fn shifted(span: Range<usize>, base: usize) -> Range<usize> {
    span.start + base..span.end + base
}

/// Lays `over` onto `under`: tables key by key, everything else replaces.
///
/// A variant that `over` names replaces another one below: `planner.survey = {}` over
/// `[planner.rapid]` leaves only the former.
pub(super) fn lay_over<'t>(under: &mut DeTable<'t>, over: DeTable<'t>) {
    lay_over_at(under, over, true);
}

fn lay_over_at<'t>(under: &mut DeTable<'t>, over: DeTable<'t>, at_top: bool) {
    for (key, value) in over {
        let name = key.get_ref().clone();
        match (under.get_mut(name.as_ref()), value) {
            (Some(old), value) if is_table(old) && is_table(&value) => {
                let DeValue::Table(new_table) = value.into_inner() else { continue };
                let DeValue::Table(old_table) = old.get_mut() else { continue };
                if at_top && VARIANTS.contains(&name.as_ref()) {
                    keep(old_table, |variant| new_table.contains_key(variant));
                }
                lay_over_at(old_table, new_table, false);
            }
            (_, value) => {
                under.remove(name.as_ref());
                under.insert(key, value);
            }
        }
    }
}

/// Drops the keys of a table that are not `wanted`.
pub(super) fn keep(table: &mut DeTable<'_>, wanted: impl Fn(&str) -> bool) {
    let all = std::mem::take(table);
    *table = all.into_iter().filter(|(key, _)| wanted(key.get_ref())).collect();
}

fn is_table(value: &Spanned<DeValue<'_>>) -> bool {
    matches!(value.get_ref(), DeValue::Table(_))
}

/// The table at `key` of `table`, if it is one.
pub(super) fn table_at<'a, 't>(table: &'a DeTable<'t>, key: &str) -> Option<&'a DeTable<'t>> {
    match table.get(key)?.get_ref() {
        DeValue::Table(inner) => Some(inner),
        _ => None,
    }
}

/// Every key of the document by its dotted path, with where it and its value stand.
pub(super) fn spans(table: &DeTable<'_>) -> BTreeMap<String, Spans> {
    let mut all = BTreeMap::new();
    collect(table, "", &mut all);
    all
}

fn collect(table: &DeTable<'_>, prefix: &str, all: &mut BTreeMap<String, Spans>) {
    for (key, value) in table {
        let path = join(prefix, key.get_ref());
        if let DeValue::Table(inner) = value.get_ref() {
            collect(inner, &path, all);
        }
        all.insert(path, Spans { key: key.span(), value: value.span() });
    }
}

/// `prefix.key`, or `key` at the top.
pub(super) fn join(prefix: &str, key: &str) -> String {
    if prefix.is_empty() { key.to_owned() } else { format!("{prefix}.{key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(table: &DeTable<'_>) -> Vec<String> {
        spans(table).into_keys().collect()
    }

    #[test]
    fn a_table_is_laid_over_key_by_key() {
        let mut under = DeTable::parse("[a]\nx = 1\ny = 2\n[b]\nz = 3").unwrap().into_inner();
        let over = moved(DeTable::parse("a.x = 5").unwrap().into_inner(), 100);
        lay_over(&mut under, over);
        assert_eq!(keys(&under), ["a", "a.x", "a.y", "b", "b.z"]);
        assert_eq!(spans(&under)["a.x"].value, 106..107);
    }

    #[test]
    fn a_named_variant_replaces_the_other() {
        let mut under = DeTable::parse("[planner.rapid]\nstep_m = 1").unwrap().into_inner();
        let over = moved(DeTable::parse("planner.survey = {}").unwrap().into_inner(), 100);
        lay_over(&mut under, over);
        assert_eq!(keys(&under), ["planner", "planner.survey"]);
    }
}
