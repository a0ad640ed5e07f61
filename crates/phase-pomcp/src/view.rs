//! The tree of a search as data to look at: as text, as a graph, as JSON.

use std::fmt::{self, Debug, Display, Write};

/// A history of the tree (a node that actions and observations lead to), with the first levels below it.
///
/// [`Pomcp::view`](crate::Pomcp::view) makes it. `{}` prints it as indented text, one action a line.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryView<O> {
    /// Number of simulations that chose an action here.
    pub visits: usize,
    /// The legal actions, most visited first, those with more value first among equals; empty where nothing
    /// was tried.
    pub actions: Vec<ActionView<O>>,
}

/// An action after a history.
#[derive(Debug, Clone, PartialEq)]
pub struct ActionView<O> {
    /// The action's number.
    pub action: usize,
    /// Number of simulations that chose it here.
    pub visits: usize,
    /// The mean of their discounted returns, in the reward's unit; 0 where there were none.
    pub value: f64,
    /// The prior probability, 0 to 1.
    pub prior: f64,
    /// Observations made after it, with the histories that follow, most visited first.
    pub branches: Vec<(O, HistoryView<O>)>,
}

impl<O> HistoryView<O> {
    /// The principal variation: the most visited action, its most visited observation, the most visited
    /// action after that, and so on. The last action has no observation, as far as the view reaches.
    #[must_use]
    pub fn principal_variation(&self) -> Vec<(&ActionView<O>, Option<&O>)> {
        let mut variation = Vec::new();
        let mut history = self;
        while let Some(action) = history.actions.first().filter(|action| action.visits > 0) {
            let next = action.branches.first();
            variation.push((action, next.map(|(observation, _)| observation)));
            let Some((_, after)) = next else { break };
            history = after;
        }
        variation
    }
}

impl<O: Debug> HistoryView<O> {
    /// A graph in the language of Graphviz: histories are points, actions boxes with value and visits, and
    /// observations are written on the edges. `name` is what an action is called.
    #[must_use]
    pub fn to_dot(&self, name: impl Fn(usize) -> String) -> String {
        let mut text = String::from("digraph {\n  h0 [shape=point]\n");
        let mut next = 1;
        self.dot_into(0, &name, &mut next, &mut text);
        text.push_str("}\n");
        text
    }

    /// Writes what follows the node `h{from}`; `next` is the first number that is free.
    fn dot_into(&self, from: usize, name: &impl Fn(usize) -> String, next: &mut usize, text: &mut String) {
        for action in &self.actions {
            let label = quoted(&format!(
                "{}\n{:.3}, {} visits, prior {:.3}",
                name(action.action),
                action.value,
                action.visits,
                action.prior
            ));
            let here = *next;
            *next += 1;
            // Writing to a string does not fail.
            let _ = writeln!(text, "  a{here} [shape=box, label={label}]\n  h{from} -> a{here}");
            for (observation, after) in &action.branches {
                let there = *next;
                *next += 1;
                let label = quoted(&format!("{observation:?}, {} visits", after.visits));
                let _ = writeln!(text, "  h{there} [shape=point]\n  a{here} -> h{there} [label={label}]");
                after.dot_into(there, name, next, text);
            }
        }
    }

    /// JSON: `{"visits": …, "actions": [{"action": …, "visits": …, "value": …, "prior": …, "branches":
    /// [{"observation": "…", "after": …}]}]}`, where `after` is again such an object and an observation is
    /// its `Debug` text.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut text = String::new();
        self.json_into(&mut text);
        text
    }

    fn json_into(&self, text: &mut String) {
        let _ = write!(text, "{{\"visits\":{},\"actions\":[", self.visits);
        for (k, action) in self.actions.iter().enumerate() {
            let ActionView { action, visits, value, prior, branches } = action;
            let comma = if k == 0 { "" } else { "," };
            let _ = write!(
                text,
                "{comma}{{\"action\":{action},\"visits\":{visits},\"value\":{value},\"prior\":{prior},\"branches\":["
            );
            for (k, (observation, after)) in branches.iter().enumerate() {
                let comma = if k == 0 { "" } else { "," };
                let _ = write!(
                    text,
                    "{comma}{{\"observation\":{},\"after\":",
                    quoted(&format!("{observation:?}"))
                );
                after.json_into(text);
                text.push('}');
            }
            text.push_str("]}");
        }
        text.push_str("]}");
    }
}

/// Text in quotation marks, as JSON and Graphviz both read it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for symbol in text.chars() {
        match symbol {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            symbol if symbol.is_control() => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(symbol));
            }
            symbol => quoted.push(symbol),
        }
    }
    quoted.push('"');
    quoted
}

impl<O: Debug> Display for HistoryView<O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fmt_at(0, f)
    }
}

impl<O: Debug> HistoryView<O> {
    fn fmt_at(&self, depth: usize, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for ActionView { action, visits, value, prior, branches } in &self.actions {
            let indent = 4 * depth;
            writeln!(f, "{:indent$}{action}: {value:.3}, {visits} visits, prior {prior:.3}", "")?;
            for (observation, after) in branches {
                let indent = 4 * depth + 2;
                writeln!(f, "{:indent$}{observation:?}, {} visits", "", after.visits)?;
                after.fmt_at(depth + 1, f)?;
            }
        }
        Ok(())
    }
}
