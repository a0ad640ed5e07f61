//! Reports: two forms of the same, and nothing of an id or name becomes markup.

use phase_eval::{
    published,
    report::{Block, Document},
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

#[test]
fn published_rows_are_shares_and_in_order() {
    for row in published::GOALS {
        let [one, two, three] = row.goal;
        assert!(0.0 < one && one <= two && two <= three && three <= 1.0, "{row:?}");
    }
    for row in published::TRAJECTORIES {
        let [independent, social, all] = row.ade;
        assert!(independent <= all && all <= social && row.fde[2] >= all, "{row:?}");
    }
}
