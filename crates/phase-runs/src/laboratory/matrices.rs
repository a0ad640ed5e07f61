//! Representational dissimilarity matrices of answers, ratings and tables of features, and how alike they
//! are.

use super::{
    create,
    tables::{MISSING, Sheet, Table, unknown_form, unusable},
};
use crate::{error::RunError, listener::Listener};
use phase_eval::{predictions, ratings};
use phase_files::{WriteError, atomic, regular};
use phase_laboratory::representation::{Dissimilarity, Distance, Rank, Similarity, similarity, unique};
use phase_model::random::{Purpose, stream};
use serde::Serialize;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

/// The value of the field `format` of the results.
const MATRICES_FORMAT: &str = "phase-rdm/1";
/// Bootstrap resamples over stimuli.
const RESAMPLES: usize = 1000;
/// Side of the square of a pair in a picture (pixels).
const CELL: usize = 6;

/// A file of features: where they come from, and the name of their matrix.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Source {
    /// The name of its matrices; of answers, `NAME.relation`, `NAME.goals` and `NAME.reported`.
    pub name: String,
    /// `results.json` of `eval goals`, `phase-ratings/1`, or a table (TSV or CSV) with a column of ids.
    pub file: PathBuf,
    /// Of a table, the columns whose names begin so; all columns of numbers if empty.
    pub columns: String,
}

/// A run that makes matrices and correlates them.
#[derive(Clone, Debug)]
pub struct MatrixRun {
    /// Features.
    pub sources: Vec<Source>,
    /// Only these stimuli, if there are any.
    pub ids: Vec<String>,
    /// The measure of dissimilarity.
    pub distance: Distance,
    /// The correlation of two matrices.
    pub rank: Rank,
    /// The matrix that the others are to explain, such as that of people.
    pub target: Option<String>,
    /// Random seed of the intervals.
    pub seed: u64,
    /// The folder to write.
    pub out: PathBuf,
}

/// The similarity of two matrices.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Correlation {
    /// One matrix, the target if it is one of them.
    pub one: String,
    /// The other.
    pub other: String,
    /// Their rank correlation; null where one is constant.
    pub correlation: Option<Similarity>,
    /// Of a target, the semipartial correlation: what the other explains beyond all remaining matrices but
    /// those of the target's own file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unique: Option<Similarity>,
}

/// Matrices that were made.
#[derive(Clone, PartialEq, Debug)]
pub struct Matrices {
    /// Their names.
    pub names: Vec<String>,
    /// The stimuli, in the order of rows.
    pub stimuli: Vec<String>,
    /// Of every two.
    pub correlations: Vec<Correlation>,
    /// The noise ceiling of every matrix of ratings, by name: the similarity of halves of the raters,
    /// corrected to all.
    pub ceilings: BTreeMap<String, Option<f64>>,
}

/// Features of stimuli by id.
type Features = BTreeMap<String, Vec<f64>>;

impl MatrixRun {
    /// Makes the matrices, and writes of each `NAME.npy` (condensed), `NAME.csv` (square) and `NAME.png`, and
    /// `rdm.json` with the order of stimuli and all correlations.
    ///
    /// # Errors
    /// If a file cannot be used or written, or fewer than three stimuli are in all of them.
    pub fn run(&self, listener: &dyn Listener) -> Result<Matrices, RunError> {
        let mut features: Vec<(String, Features)> = Vec::new();
        let mut ceilings = BTreeMap::new();
        let mut counts = BTreeMap::new();
        for source in &self.sources {
            for (name, of) in read(source, &mut counts)? {
                let valid = !name.is_empty() && phase_model::path::check_file_name(&name).is_ok();
                if !valid || features.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name)) {
                    return Err(RunError::Usage(format!(
                        "{name:?}: names of matrices must be different, also in small letters, and fit as \
                         names of files; give them as NAME=FILE"
                    )));
                }
                features.push((name, of));
            }
        }
        if let Some(target) = &self.target
            && features.iter().all(|(name, _)| name != target)
        {
            let known: Vec<&str> = features.iter().map(|(name, _)| name.as_str()).collect();
            return Err(RunError::Usage(format!(
                "--target: there is no matrix {target:?}; there are {}",
                known.join(", ")
            )));
        }
        let stimuli = self.stimuli(&features, listener)?;
        let mut matrices = Vec::new();
        for (name, features) in &features {
            let rows: Vec<(String, Vec<f64>)> =
                stimuli.iter().filter_map(|id| Some((id.clone(), features.get(id)?.clone()))).collect();
            let matrix = Dissimilarity::of(&rows, self.distance)
                .map_err(|error| RunError::Usage(format!("{name}: {error}")))?;
            matrices.push((name.clone(), matrix));
        }
        for (name, counts) in &counts {
            let counts: Vec<ratings::RatingCounts> =
                stimuli.iter().filter_map(|id| counts.get(id).copied()).collect();
            ceilings.insert(name.clone(), phase_eval::goals::similarity_ceiling(&counts, self.seed));
        }
        let correlations = self.correlations(&matrices);
        create(&self.out)?;
        for (name, matrix) in &matrices {
            atomic::write(&self.out.join(format!("{name}.npy")), &matrix.to_npy())?;
            square(matrix).write_csv(&self.out.join(format!("{name}.csv")))?;
            let path = self.out.join(format!("{name}.png"));
            atomic::write(&path, &picture(matrix, &path)?)?;
        }
        let names: Vec<String> = matrices.into_iter().map(|(name, _)| name).collect();
        let result = json!({
            "format": MATRICES_FORMAT,
            "distance": self.distance,
            "correlation": self.rank,
            "seed": self.seed,
            "resamples": RESAMPLES,
            "matrices": names,
            "stimuli": stimuli,
            "correlations": correlations,
            "ceilings": ceilings,
        });
        atomic::write_json(&self.out.join("rdm.json"), &result)?;
        Ok(Matrices { names, stimuli, correlations, ceilings })
    }

    /// The stimuli that every file has.
    fn stimuli(
        &self,
        features: &[(String, Features)],
        listener: &dyn Listener,
    ) -> Result<Vec<String>, RunError> {
        let Some((_, first)) = features.first() else {
            return Err(RunError::Usage("features: at least one file is needed".into()));
        };
        let wanted = |id: &&String| self.ids.is_empty() || self.ids.contains(id);
        let everywhere = |id: &&String| features.iter().all(|(_, features)| features.contains_key(*id));
        let stimuli: Vec<String> = first.keys().filter(wanted).filter(everywhere).cloned().collect();
        if let Some(id) = self.ids.iter().find(|id| !stimuli.contains(id)) {
            return Err(RunError::Usage(format!("--id {id}: is not in all files")));
        }
        let most = features.iter().map(|(_, features)| features.len()).max().unwrap_or(0);
        if stimuli.len() < most && self.ids.is_empty() {
            listener.note(&format!(
                "{} of {most} stimuli are in all files; the others are left out",
                stimuli.len()
            ));
        }
        Ok(stimuli)
    }

    fn correlations(&self, matrices: &[(String, Dissimilarity)]) -> Vec<Correlation> {
        let mut pairs = Vec::new();
        for k in 0..matrices.len() {
            for (other, (name, _)) in matrices.iter().enumerate().skip(k + 1) {
                // The target comes first.
                let is_target = self.target.as_ref() == Some(name);
                pairs.push(if is_target { (other, k) } else { (k, other) });
            }
        }
        let random = || stream(self.seed, Purpose::Bootstrap, 0);
        let of = |(one, other): (usize, usize)| {
            let (one_name, one_matrix) = &matrices[one];
            let (other_name, other_matrix) = &matrices[other];
            let is_target = self.target.as_ref() == Some(one_name);
            let rest: Vec<&Dissimilarity> = matrices
                .iter()
                .enumerate()
                .filter(|(k, (name, _))| *k != one && *k != other && family(name) != family(one_name))
                .map(|(_, (_, matrix))| matrix)
                .collect();
            Correlation {
                one: one_name.clone(),
                other: other_name.clone(),
                correlation: similarity(one_matrix, other_matrix, self.rank, RESAMPLES, &mut random()),
                unique: if is_target {
                    unique(one_matrix, other_matrix, &rest, RESAMPLES, &mut random())
                } else {
                    None
                },
            }
        };
        pairs.into_iter().map(of).collect()
    }
}

/// The part of a name that matrices of one file share.
fn family(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// The features of a file, by the names of their matrices. Counts of raters are kept by name.
fn read(
    source: &Source,
    counts: &mut BTreeMap<String, BTreeMap<String, ratings::RatingCounts>>,
) -> Result<Vec<(String, Features)>, RunError> {
    let Source { name, file, columns } = source;
    if file.extension().is_some_and(|it| it == "tsv" || it == "csv") {
        return Ok(vec![(name.clone(), table(file, columns)?)]);
    }
    let document: Value = phase_model::json::parse(&regular::bytes(file)?)
        .map_err(|error| unusable(file, &error.to_string()))?;
    if document["format"] == ratings::RATINGS_FORMAT {
        let rated = ratings::ratings(&document).map_err(|error| unusable(file, &error.to_string()))?;
        let shares = |counts: &ratings::RatingCounts| {
            counts.counts().iter().map(|&count| count as f64 / counts.raters() as f64).collect::<Vec<f64>>()
        };
        let features = rated.iter().map(|(id, counts)| (id.clone(), shares(counts))).collect();
        counts.insert(name.clone(), rated);
        return Ok(vec![(name.clone(), features)]);
    }
    if document["events"].is_array() {
        return answers(name, file, &document);
    }
    Err(unknown_form(file, "results of `eval goals`, phase-ratings/1, a table that ends in .tsv or .csv"))
}

/// Relation, goals and predicted reports of answers to Task 1.
fn answers(name: &str, file: &Path, document: &Value) -> Result<Vec<(String, Features)>, RunError> {
    let answers = predictions::goals(document).map_err(|error| unusable(file, &error.to_string()))?;
    let shares = |p: &phase_model::RelationProbabilities| vec![p.friendly, p.adversarial, p.neutral];
    let mut known: Vec<(usize, phase_model::Goal)> = Vec::new();
    for judgement in answers.values() {
        for (agent, goals) in judgement.goals.iter().enumerate() {
            for named in goals {
                let goal = (agent, phase_eval::goals::canonical(named.goal));
                if !known.contains(&goal) {
                    known.push(goal);
                }
            }
        }
    }
    let mut of: [Features; 3] = Default::default();
    for (id, judgement) in &answers {
        of[0].insert(id.clone(), shares(&judgement.relation));
        let p = |&(agent, goal): &(usize, phase_model::Goal)| {
            let goals = judgement.goals[agent].iter();
            goals.filter(|named| phase_eval::goals::canonical(named.goal) == goal).map(|named| named.p).sum()
        };
        of[1].insert(id.clone(), known.iter().map(p).collect());
        if let Some(reported) = &judgement.reported {
            of[2].insert(id.clone(), shares(reported));
        }
    }
    let all = answers.len();
    let [relation, goals, reported] = of;
    let mut features = vec![(format!("{name}.relation"), relation), (format!("{name}.goals"), goals)];
    if reported.len() == all {
        features.push((format!("{name}.reported"), reported));
    }
    Ok(features)
}

/// The features of a table: the numbers of some columns, of all rows of a stimulus in their order.
fn table(file: &Path, prefix: &str) -> Result<Features, RunError> {
    const IDS: [&str; 4] = ["id", "trial_type", "stim_id", "stim_file"];
    const NO_FEATURES: [&str; 2] = ["onset", "duration"];
    let sheet = Sheet::read(file)?;
    let Some(id) = IDS.iter().find_map(|name| sheet.column(name)) else {
        return Err(unusable(file, &format!("has no column of ids: {}", IDS.join(", "))));
    };
    let wanted = |name: &String| !IDS.contains(&name.as_str()) && !NO_FEATURES.contains(&name.as_str());
    let chosen: Vec<usize> = (0..sheet.names.len())
        .filter(|&k| wanted(&sheet.names[k]) && sheet.names[k].starts_with(prefix))
        .collect();
    if chosen.is_empty() {
        return Err(unusable(file, &format!("has no column of features that begins with {prefix:?}")));
    }
    let mut features = Features::new();
    for (k, row) in sheet.rows.iter().enumerate() {
        let values = features.entry(row[id].clone()).or_default();
        for &column in &chosen {
            let (name, cell) = (&sheet.names[column], &row[column]);
            let value = match cell.as_str() {
                // A goal for an object that is not there has no probability.
                MISSING if name.contains("_wants_") => Some(0.0),
                MISSING => {
                    let rule = format!("row {}: {name} is missing; choose other columns or rows", k + 1);
                    return Err(unusable(file, &rule));
                }
                _ => cell.parse::<f64>().ok(),
            };
            let value = value
                .filter(|value| value.is_finite())
                .ok_or_else(|| unusable(file, &format!("row {}: {name} {cell:?} is no number", k + 1)))?;
            values.push(value);
        }
    }
    Ok(features)
}

fn square(matrix: &Dissimilarity) -> Table {
    let mut table = Table::default();
    table.column("id", "", "");
    matrix.ids.iter().for_each(|id| table.column(id.clone(), "", ""));
    let row = |a: usize| {
        let cells = (0..matrix.ids.len()).map(|b| format!("{:.6}", matrix.at(a, b)));
        core::iter::once(matrix.ids[a].clone()).chain(cells).collect()
    };
    table.rows = (0..matrix.ids.len()).map(row).collect();
    table
}

/// The matrix as a picture: dark where two stimuli are alike, light where they differ most.
fn picture(matrix: &Dissimilarity, path: &Path) -> Result<Vec<u8>, RunError> {
    let count = matrix.ids.len();
    let most = matrix.condensed.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let side = count * CELL;
    let mut pixels = Vec::with_capacity(side * side * 3);
    for y in 0..side {
        for x in 0..side {
            pixels.extend(colour(matrix.at(y / CELL, x / CELL) / most));
        }
    }
    let failed = |error: png::EncodingError| {
        RunError::Output(WriteError {
            path: path.to_owned(),
            action: "encode the picture",
            source: std::io::Error::other(error),
        })
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// A colour map that stays in order without colours: five points of viridis, and between them straight lines.
fn colour(share: f64) -> [u8; 3] {
    const POINTS: [[f64; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [59.0, 82.0, 139.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    let place = share.clamp(0.0, 1.0) * (POINTS.len() - 1) as f64;
    let low = (place as usize).min(POINTS.len() - 2);
    core::array::from_fn(|k| {
        (POINTS[low][k] + (place - low as f64) * (POINTS[low + 1][k] - POINTS[low][k])) as u8
    })
}
