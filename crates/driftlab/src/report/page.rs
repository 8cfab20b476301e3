//! The report as Markdown and as a page of its own.

use std::fmt::Write as _;

use super::tables::TextTable;

/// A part of a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Section {
    /// Its heading.
    pub(crate) title: String,
    /// 1 for the heading of a study, 2 for its parts.
    pub(crate) level: usize,
    /// What it says, in plain text with names of things between backticks.
    pub(crate) text: String,
    /// Its table.
    pub(crate) table: Option<TextTable>,
    /// Its plots.
    pub(crate) plots: Vec<Plot>,
}

/// A drawn plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Plot {
    /// The name of its file.
    pub(crate) file: String,
    /// What it shows.
    pub(crate) about: String,
    /// The drawing.
    pub(crate) svg: String,
}

/// The report in Markdown; plots are in the folder `plots` beside it.
pub(crate) fn markdown(title: &str, sections: &[Section]) -> String {
    let mut page = format!("# {title}\n");
    for section in sections {
        let _ = write!(page, "\n{} {}\n", "#".repeat(section.level + 1), section.title);
        if !section.text.is_empty() {
            let _ = write!(page, "\n{}\n", section.text);
        }
        if let Some(table) = &section.table {
            page.push('\n');
            let cells = |row: &[String]| {
                row.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>().join(" | ")
            };
            let _ = writeln!(page, "| {} |", cells(&table.header));
            let rule = |column: usize| if column < table.names { "---|" } else { "---:|" };
            let rules: String = (0..table.header.len()).map(rule).collect();
            let _ = writeln!(page, "|{rules}");
            for row in &table.rows {
                let _ = writeln!(page, "| {} |", cells(row));
            }
        }
        if !section.plots.is_empty() {
            page.push('\n');
        }
        for plot in &section.plots {
            let _ = writeln!(page, "![{}](plots/{})", plot.about, plot.file);
        }
    }
    page
}

/// What the page looks like; it asks for nothing from elsewhere.
const STYLE: &str = "body{font:15px/1.5 sans-serif;max-width:1480px;margin:2em auto;padding:0 1em;\
color:#222}h2{border-top:1px solid #ccc;padding-top:.7em;margin-top:2em}table{border-collapse:\
collapse;font-size:13px;margin:.7em 0;display:block;overflow-x:auto}th,td{border-bottom:1px solid #ddd;padding:.2em .7em;\
text-align:right;white-space:nowrap}th.n,td.n{text-align:left}thead th{border-bottom:2px solid #888}\
figure{display:inline-block;margin:.3em}p{max-width:60em;white-space:pre-line}";

/// The report as one HTML page that holds everything.
pub(crate) fn html(title: &str, sections: &[Section]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <title>{0}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
        escaped(title)
    );
    for section in sections {
        let level = section.level + 1;
        let _ = writeln!(page, "<h{level}>{}</h{level}>", escaped(&section.title));
        if !section.text.is_empty() {
            let _ = writeln!(page, "<p>{}</p>", with_code(&section.text));
        }
        if let Some(table) = &section.table {
            let line = |row: &[String], tag: &str| {
                let cells = row.iter().enumerate().map(|(column, cell)| {
                    let class = if column < table.names { " class=\"n\"" } else { "" };
                    format!("<{tag}{class}>{}</{tag}>", escaped(cell))
                });
                format!("<tr>{}</tr>\n", cells.collect::<String>())
            };
            let _ =
                write!(page, "<table>\n<thead>{}</thead>\n<tbody>\n", line(&table.header, "th"));
            table.rows.iter().for_each(|row| page.push_str(&line(row, "td")));
            page.push_str("</tbody>\n</table>\n");
        }
        for plot in &section.plots {
            let _ = write!(
                page,
                "<figure aria-label=\"{}\">\n{}</figure>\n",
                escaped(&plot.about),
                plot.svg
            );
        }
    }
    page.push_str("</body>\n</html>\n");
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The text with what stands between backticks as code; a backtick without a partner stays.
fn with_code(text: &str) -> String {
    let mut page = String::new();
    let mut parts = text.split('`').map(escaped).peekable();
    let mut is_code = false;
    while let Some(part) = parts.next() {
        match (is_code, parts.peek().is_some()) {
            (true, true) => page.push_str(&format!("<code>{part}</code>")),
            (true, false) => page.push_str(&format!("`{part}")),
            (false, _) => page.push_str(&part),
        }
        is_code = !is_code;
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_between_backticks_are_code() {
        assert_eq!(with_code("by `a<b`, not `c`."), "by <code>a&lt;b</code>, not <code>c</code>.");
        assert_eq!(with_code("a ` b"), "a ` b");
        assert_eq!(with_code(""), "");
    }

    fn sections() -> Vec<Section> {
        let table = TextTable {
            header: vec!["map".into(), "d_max m".into()],
            rows: vec![vec!["a|b".into(), "3 < 4".into()]],
            names: 1,
        };
        let plot = Plot {
            file: "one.svg".into(),
            about: "over \"distance\"".into(),
            svg: "<svg></svg>\n".into(),
        };
        vec![Section {
            title: "Results".into(),
            level: 1,
            text: "What came of it.".into(),
            table: Some(table),
            plots: vec![plot],
        }]
    }

    #[test]
    fn the_markdown_has_the_table_and_names_the_plots() {
        let expected = "# Report\n\n## Results\n\nWhat came of it.\n\n| map | d_max m |\n|---|---:|\n\
                        | a\\|b | 3 < 4 |\n\n![over \"distance\"](plots/one.svg)\n";
        assert_eq!(markdown("Report", &sections()), expected);
    }

    #[test]
    fn the_page_holds_everything_and_asks_for_nothing() {
        let page = html("R & D", &sections());
        assert!(page.contains("<h1>R &amp; D</h1>") && page.contains("<svg></svg>"), "{page}");
        assert!(page.contains("<td class=\"n\">a|b</td><td>3 &lt; 4</td>"), "{page}");
        for word in ["http", "src=", "href", "url("] {
            assert!(!page.contains(word), "{word}");
        }
    }
}
