//! Documents as Markdown and as pages; no name becomes markup.

use phase_document::{
    document::{Block, Document},
    plot::{Axis, Series, line_chart},
};

#[test]
fn text_stays_text() {
    let table = Block::Table { head: vec!["a|b".into()], rows: vec![vec!["<script>&".into()]] };
    let plot = Block::Plot { file: "x.svg", title: "X".into(), svg: "<svg></svg>".into() };
    let document = Document { title: "<b>".into(), blocks: vec![table, plot] };
    let (page, text) = (document.to_html(), document.to_markdown());
    assert!(page.contains("&lt;script&gt;&amp;") && page.contains("<h1>&lt;b&gt;</h1>"), "{page}");
    assert!(page.contains("<svg></svg>") && !page.contains("<script>"), "{page}");
    assert!(text.contains("| a\\|b |\n| --- |\n") && text.contains("![X](x.svg)"), "{text}");
    assert_eq!(document.plots().collect::<Vec<_>>(), [("x.svg", "<svg></svg>")]);
}

/// A name that somebody chose is no markup in Markdown either, which may hold HTML.
#[test]
fn names_are_no_markup_in_markdown() {
    let name = "<img src=x onerror=alert(1)>\n# [a](javascript:b) ![c](http://d) `e` *f* \\|";
    let table = Block::Table { head: vec![name.into()], rows: vec![vec![name.into()]] };
    let blocks = vec![Block::Heading(name.into()), Block::Text(name.into()), table];
    let text = Document { title: name.into(), blocks }.to_markdown();
    let expected =
        "&lt;img src=x onerror=alert(1)&gt; # [a\\](javascript:b) ![c\\](http://d) \\`e\\` \\*f\\* \\\\\\|";
    assert_eq!(text.matches(expected).count(), 5, "{text}");
    assert!(!text.contains('<') && text.lines().filter(|line| line.starts_with('#')).count() == 2, "{text}");
}

/// From 0 to the first round step that is large enough.
#[test]
fn marks_are_round_numbers() {
    for (to, expected) in [
        (1.0, ["0", "0.2", "0.4", "0.6", "0.8", "1"].as_slice()),
        (10.0, &["0", "2", "4", "6", "8", "10"]),
        (79.0, &["0", "20", "40", "60", "80"]),
        (4.0, &["0", "1", "2", "3", "4"]),
        (0.3, &["0", "0.1", "0.2", "0.3"]),
        (101.0, &["0", "50", "100", "150"]),
        (1e-320, &["0", "0", "0", "0", "0", "0"]),
        (f64::NAN, &["0", "0.2", "0.4", "0.6", "0.8", "1"]),
        (-1.0, &["0", "0.2", "0.4", "0.6", "0.8", "1"]),
    ] {
        let axes = [Axis::linear("x", to), Axis::linear("y", 1.0)];
        let svg = line_chart("Marks", axes, &[]);
        let ticks: Vec<&str> = svg
            .lines()
            .filter(|line| line.starts_with("<path") && line.contains("text-anchor=\"middle\""))
            .filter_map(|line| line.strip_suffix("</text>")?.rsplit('>').next())
            .collect();
        assert_eq!(ticks, expected, "{to}");
    }
}

#[test]
fn curves_leave_out_what_is_no_number_and_stay_in_the_field() {
    let points = vec![(0.0, 0.0), (f64::NAN, 1.0), (5.0, f64::INFINITY), (20.0, 2.0), (10.0, 1.0)];
    let axes = [Axis::linear("x <s>", 10.0), Axis::linear("y", 1.0)];
    let svg = line_chart("A & B", axes, &[Series { name: "ours", points }]);
    let [low, high] =
        [svg.find("points=\"").expect("a line") + 8, svg.find("\" fill=\"none\"").expect("its end")];
    let drawn: Vec<&str> = svg[low..high].split(' ').collect();
    // The origin below left, then twice the far corner.
    assert_eq!(drawn, ["64.0,384.0", "544.0,64.0", "544.0,64.0"]);
    assert!(svg.contains("A &amp; B") && svg.contains("x &lt;s&gt;") && !svg.contains("NaN"), "{svg}");
}
