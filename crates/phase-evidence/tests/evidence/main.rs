//! Judgements on synthetic tracks.

mod certain;
mod clarity;
mod contact;
mod discovery;
mod drawn;
mod effect;
mod exploration;
mod holding;
mod manner;
mod motion;
mod narrative;
mod outcome;
mod parting;
mod pursuit;
mod rest;
mod search;
mod selection;
mod support;
mod way;
