//! Numbers for people.

/// Six significant digits, plain where that is short.
pub(in crate::command) fn shown(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if !(1e-4..1e9).contains(&size) {
        return format!("{value:.5e}");
    }
    let digits = (5 - size.log10().floor() as i64).max(0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Names and values under each other, the values in one column.
pub(in crate::command) fn listed(rows: &[(&str, String)]) -> String {
    let width = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    rows.iter().map(|(name, value)| format!("{name:width$}  {value}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_and_no_more() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (123_456_789.0, "123456789"),
            (1234.5678, "1234.57"),
            (0.012_345_678, "0.0123457"),
            (1e-9, "1.00000e-9"),
            (-2.5e12, "-2.50000e12"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in cases {
            assert_eq!(shown(value), text);
        }
    }
}
