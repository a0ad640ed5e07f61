//! Reading raters.

use super::{Page, StoreError, StoreProblem, Writing};
use crate::{
    question::Responses,
    record::{Departure, GivenAnswer, Rater, Trial},
};
use phase_model::json::parse_as;
use rusqlite::{OptionalExtension, Row};
use std::collections::BTreeMap;

pub(super) const fn departure_name(departure: Departure) -> &'static str {
    match departure {
        Departure::Declined => "declined",
        Departure::Withdrew => "withdrew",
    }
}

/// Everything of all raters, or of one.
const RATERS: &str = "SELECT rater.number, joined, parameters, kind FROM rater LEFT JOIN origin ON origin.rater = rater.number \
                      LEFT JOIN departure ON departure.rater = rater.number";
const PAGES: &str = "SELECT rater, page, at, answer FROM page";
const TRIALS: &str = "SELECT trial.rater, trial.number, shown, catch, at, answer, response_time, plays FROM trial \
                      LEFT JOIN answer ON answer.rater = trial.rater AND answer.number = trial.number";

impl Writing<'_> {
    /// The rater with a token of this digest.
    pub(crate) fn rater_of(&self, digest: &[u8; 32]) -> Result<Option<u64>, StoreError> {
        self.number("SELECT rater FROM token WHERE digest = ?1", [digest])
    }

    fn number(&self, sql: &str, values: impl rusqlite::Params) -> Result<Option<u64>, StoreError> {
        let found = self
            .transaction
            .prepare_cached(sql)
            .and_then(|mut statement| statement.query_row(values, |row| row.get::<_, i64>(0)).optional());
        found.map(|number| number.map(i64::unsigned_abs)).map_err(|error| self.failed(error))
    }

    /// One rater.
    pub(crate) fn rater(&self, number: u64) -> Result<Rater, StoreError> {
        let found = self.read(Some(number))?.into_values().next();
        found.ok_or_else(|| self.damaged(number, "is missing".into()))
    }

    /// All raters in the order in which they came.
    pub(crate) fn raters(&self) -> Result<Vec<Rater>, StoreError> {
        Ok(self.read(None)?.into_values().collect())
    }

    fn damaged(&self, rater: u64, what: String) -> StoreError {
        StoreError { file: self.path.to_owned(), problem: StoreProblem::Damaged { rater, what } }
    }

    fn read(&self, one: Option<u64>) -> Result<BTreeMap<u64, Rater>, StoreError> {
        let mut raters = BTreeMap::new();
        self.each(RATERS, "rater.number", one, |row| {
            let rater = self.new_rater(row)?;
            raters.insert(rater.number, rater);
            Ok(())
        })?;
        self.each(PAGES, "page.rater, page", one, |row| {
            let number = self.rater_number(row)?;
            let page: String = self.get(row, 1)?;
            let at: i64 = self.get(row, 2)?;
            let text: Option<String> = self.get(row, 3)?;
            let rater = raters.get_mut(&number).ok_or_else(|| self.damaged(number, "is missing".into()))?;
            match Page::ALL.into_iter().find(|known| known.name() == page) {
                Some(Page::Consent) => rater.consented = Some(at),
                Some(Page::Instructions) => rater.instructed = Some(at),
                Some(Page::Demographics) => {
                    rater.demographics = Some((at, self.answer(number, &text.unwrap_or_default())?));
                }
                None => return Err(self.damaged(number, format!("there is no page {page}"))),
            }
            Ok(())
        })?;
        self.each(TRIALS, "trial.rater, trial.number", one, |row| {
            let number = self.rater_number(row)?;
            let k: i64 = self.get(row, 1)?;
            let trial = self.trial(row, number)?;
            let rater = raters.get_mut(&number).ok_or_else(|| self.damaged(number, "is missing".into()))?;
            if rater.trials.len() as i64 != k {
                return Err(self.damaged(number, format!("trial {} is missing", rater.trials.len() + 1)));
            }
            rater.trials.push(trial);
            Ok(())
        })?;
        Ok(raters)
    }

    /// Runs a query over all raters, or one, in an order that begins with the rater's number.
    fn each(
        &self,
        query: &str,
        order: &str,
        one: Option<u64>,
        mut take: impl FnMut(&Row<'_>) -> Result<(), StoreError>,
    ) -> Result<(), StoreError> {
        let column = order.split(',').next().unwrap_or_default();
        let filter = one.map_or_else(String::new, |number| format!("WHERE {column} = {number}"));
        let sql = format!("{query} {filter} ORDER BY {order}");
        let mut statement = self.transaction.prepare(&sql).map_err(|error| self.failed(error))?;
        let mut rows = statement.query([]).map_err(|error| self.failed(error))?;
        while let Some(row) = rows.next().map_err(|error| self.failed(error))? {
            take(row)?;
        }
        Ok(())
    }

    fn get<T: rusqlite::types::FromSql>(&self, row: &Row<'_>, column: usize) -> Result<T, StoreError> {
        row.get(column).map_err(|error| self.failed(error))
    }

    fn rater_number(&self, row: &Row<'_>) -> Result<u64, StoreError> {
        let number: i64 = self.get(row, 0)?;
        u64::try_from(number)
            .map_err(|_| self.damaged(number.unsigned_abs(), "the number must not be negative".into()))
    }

    fn new_rater(&self, row: &Row<'_>) -> Result<Rater, StoreError> {
        let number = self.rater_number(row)?;
        let parameters: Option<String> = self.get(row, 2)?;
        let parameters = parameters.map_or_else(|| Ok(BTreeMap::new()), |text| parse_as(&text));
        let departure: Option<String> = self.get(row, 3)?;
        let departure = match departure.as_deref() {
            None => None,
            Some("declined") => Some(Departure::Declined),
            Some("withdrew") => Some(Departure::Withdrew),
            Some(other) => return Err(self.damaged(number, format!("there is no departure {other}"))),
        };
        Ok(Rater {
            number,
            joined: self.get(row, 1)?,
            parameters: parameters.map_err(|error| self.damaged(number, error.to_string()))?,
            departure,
            consented: None,
            demographics: None,
            instructed: None,
            trials: Vec::new(),
        })
    }

    fn trial(&self, row: &Row<'_>, number: u64) -> Result<Trial, StoreError> {
        let at: Option<i64> = self.get(row, 4)?;
        let given = match at {
            None => None,
            Some(at) => Some(GivenAnswer {
                at,
                answer: self.answer(number, &self.get::<String>(row, 5)?)?,
                response_time: self.get(row, 6)?,
                plays: self.get(row, 7)?,
            }),
        };
        Ok(Trial { shown: self.get(row, 2)?, catch: self.get(row, 3)?, given })
    }

    fn answer(&self, number: u64, text: &str) -> Result<Responses, StoreError> {
        parse_as(text).map_err(|error| self.damaged(number, error.to_string()))
    }
}
