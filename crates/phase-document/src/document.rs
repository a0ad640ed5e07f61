//! A text with tables and plots, as Markdown or as a page.

use crate::markup::{escape, escape_markdown};

/// A part of a document.
#[derive(Clone, PartialEq, Debug)]
pub enum Block {
    /// A heading.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A table.
    Table {
        /// Heads of the columns.
        head: Vec<String>,
        /// Cells of the rows.
        rows: Vec<Vec<String>>,
    },
    /// A picture.
    Plot {
        /// Name of its file, with ending.
        file: &'static str,
        /// Subject of the document, shown above everything else.
        title: String,
        /// The picture.
        svg: String,
    },
}

/// A text of several blocks below a title.
#[derive(Clone, PartialEq, Debug)]
pub struct Document {
    /// Its title.
    pub title: String,
    /// Its contents.
    pub blocks: Vec<Block>,
}

const STYLE: &str = "body{font:15px/1.5 sans-serif;max-width:75em;margin:2em auto;padding:0 1em;color:#222}\
                     table{border-collapse:collapse;margin:1em 0;display:block;overflow-x:auto}\
                     th,td{padding:.25em .8em;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}\
                     th{border-bottom:2px solid #888}svg{max-width:100%;height:auto}";

impl Document {
    /// The document as Markdown; plots are links to their files.
    #[must_use]
    pub fn to_markdown(&self) -> String {
        let blocks: Vec<String> = self.blocks.iter().map(Block::to_markdown).collect();
        format!("# {}\n\n{}", escape_markdown(&self.title), blocks.join("\n"))
    }

    /// The document as a page with everything in it.
    #[must_use]
    pub fn to_html(&self) -> String {
        let blocks = self.blocks.iter().map(|block| match block {
            Block::Heading(text) => format!("<h2>{}</h2>\n", escape(text)),
            Block::Text(text) => format!("<p>{}</p>\n", escape(text)),
            Block::Table { head, rows } => {
                let row = |tag: &str, cells: &[String]| {
                    let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell)));
                    format!("<tr>{}</tr>\n", cells.collect::<String>())
                };
                let rows: String = rows.iter().map(|cells| row("td", cells)).collect();
                format!("<table>\n{}{rows}</table>\n", row("th", head))
            }
            Block::Plot { svg, .. } => format!("<p>{svg}</p>\n"),
        });
        let title = escape(&self.title);
        let blocks = blocks.collect::<String>();
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\
             <style>{STYLE}</style></head>\n<body>\n<h1>{title}</h1>\n{blocks}</body></html>\n"
        )
    }

    /// The plots: file names and pictures.
    pub fn plots(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Plot { file, svg, .. } => Some((*file, svg.as_str())),
            _ => None,
        })
    }

    /// The first table as Markdown, for the terminal.
    #[must_use]
    pub fn first_table(&self) -> String {
        let table = self.blocks.iter().find_map(|block| match block {
            Block::Table { head, rows } => Some(markdown_table(head, rows)),
            _ => None,
        });
        table.unwrap_or_default()
    }
}

impl Block {
    /// The block as lines of Markdown; a plot is a link to its file.
    #[must_use]
    pub fn to_markdown(&self) -> String {
        match self {
            Self::Heading(text) => format!("## {}\n", escape_markdown(text)),
            Self::Text(text) => format!("{}\n", escape_markdown(text)),
            Self::Table { head, rows } => markdown_table(head, rows),
            Self::Plot { file, title, .. } => format!("![{}]({file})\n", escape_markdown(title)),
        }
    }
}

/// The head of a table with these names of columns.
#[must_use]
pub fn head(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

fn markdown_table(head: &[String], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| escape_markdown(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule = vec!["---".to_owned(); head.len()];
    let rows: String = rows.iter().map(|cells| line(cells)).collect();
    format!("{}{}{rows}", line(head), line(&rule))
}
