//! Judgements on synthetic tracks.

mod contact;
mod effect;
mod exploration;
mod holding;
mod motion;
mod outcome;
mod pursuit;
mod rest;
mod selection;
mod support;
mod way;
