//! The option `--shard`: which part of the work to do, given or taken from the environment of a cluster's
//! scheduler.

/// Variables of schedulers that number their tasks.
const SLURM_TASK: &str = "SLURM_ARRAY_TASK_ID";
const SLURM_FIRST: &str = "SLURM_ARRAY_TASK_MIN";
const SLURM_STEP: &str = "SLURM_ARRAY_TASK_STEP";
const SLURM_COUNT: &str = "SLURM_ARRAY_TASK_COUNT";
const KUBERNETES_INDEX: &str = "JOB_COMPLETION_INDEX";
const HYPERQUEUE_TASK: &str = "HQ_TASK_ID";

/// Reads a shard such as `3/16`, `auto` or `auto/16`; the last two take the number from the environment.
///
/// # Errors
/// A sentence for the user.
pub fn shard(text: &str) -> Result<(usize, usize), String> {
    parse(text, |name| std::env::var(name).ok())
}

/// As [`shard`], with an environment.
fn parse(text: &str, variable: impl Fn(&str) -> Option<String>) -> Result<(usize, usize), String> {
    let number = |name: &str| match variable(name) {
        None => Ok(None),
        Some(value) => value
            .trim()
            .parse::<usize>()
            .map(Some)
            .map_err(|_| format!("the variable {name} must be a whole number and is {value:?}")),
    };
    let (first, count) = match text.split_once('/') {
        None => (text, None),
        Some((first, count)) => (first, Some(count.parse::<usize>().map_err(|_| usage())?)),
    };
    let (k, n) = if first == "auto" {
        let (index, tasks) = task(number, count.is_some())?;
        let n = count.or(tasks).ok_or_else(|| {
            "the scheduler does not tell how many tasks there are; give it as --shard auto/N".to_owned()
        })?;
        (index + 1, n)
    } else {
        (first.parse().map_err(|_| usage())?, count.ok_or_else(usage)?)
    };
    if 1 <= k && k <= n {
        Ok((k, n))
    } else if first == "auto" {
        Err(format!("the scheduler's task is number {k} of {n}"))
    } else {
        Err(usage())
    }
}

/// The task's number from 0 and, where the scheduler tells, how many tasks there are. `counted`: whether the
/// user gives how many there are.
fn task(
    number: impl Fn(&str) -> Result<Option<usize>, String>,
    counted: bool,
) -> Result<(usize, Option<usize>), String> {
    if let Some(id) = number(SLURM_TASK)? {
        // Tasks that failed may be submitted again as a smaller array: their own numbers, from 1, are what
        // stays.
        if counted {
            return id.checked_sub(1).map(|index| (index, None)).ok_or_else(|| format!("{SLURM_TASK} is 0"));
        }
        // A whole array need not begin with 0 or 1, nor go on by one.
        let first = number(SLURM_FIRST)?.unwrap_or(0);
        let step = number(SLURM_STEP)?.unwrap_or(1).max(1);
        let offset =
            id.checked_sub(first).ok_or_else(|| format!("{SLURM_TASK} is less than {SLURM_FIRST}"))?;
        return Ok((offset / step, number(SLURM_COUNT)?));
    }
    if let Some(index) = number(KUBERNETES_INDEX)? {
        return Ok((index, None));
    }
    if let Some(id) = number(HYPERQUEUE_TASK)? {
        // Arrays of HyperQueue begin with 1 here, as `--array 1-16` of its manual does.
        return id.checked_sub(1).map(|index| (index, None)).ok_or_else(|| format!("{HYPERQUEUE_TASK} is 0"));
    }
    Err(format!("none of {SLURM_TASK}, {KUBERNETES_INDEX} and {HYPERQUEUE_TASK} is set; give a shard as K/N"))
}

fn usage() -> String {
    "a shard is K/N with K from 1 to N, such as 3/16, or auto or auto/N in a task of a scheduler".into()
}

#[cfg(test)]
mod tests {
    use super::parse;

    /// Variables with their values.
    type Set<'a> = &'a [(&'a str, &'a str)];

    fn of(text: &str, set: Set<'_>) -> Result<(usize, usize), String> {
        parse(text, |name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned()))
    }

    #[test]
    fn shards_are_given_or_the_schedulers_tasks() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "14"),
            ("SLURM_ARRAY_TASK_MIN", "10"),
            ("SLURM_ARRAY_TASK_STEP", "2"),
            ("SLURM_ARRAY_TASK_COUNT", "4"),
        ];
        assert_eq!(of("3/16", &slurm), Ok((3, 16)));
        assert_eq!(of("auto", &slurm), Ok((3, 4)));
        // Task 14 of an array of which only some tasks are submitted again.
        assert_eq!(of("auto/16", &slurm), Ok((14, 16)));
        assert_eq!(of("auto/16", &[("JOB_COMPLETION_INDEX", "15")]), Ok((16, 16)));
        assert_eq!(of("auto/16", &[("HQ_TASK_ID", "16")]), Ok((16, 16)));
    }

    #[test]
    fn what_is_no_shard_is_refused_in_a_sentence() {
        let kubernetes = [("JOB_COMPLETION_INDEX", "16")];
        let cases: [(&str, Set<'_>, &str); 10] = [
            ("auto/4", &[("SLURM_ARRAY_TASK_ID", "0")], "is 0"),
            ("0/4", &[], "K/N"),
            ("5/4", &[], "K/N"),
            ("x/4", &[], "K/N"),
            ("4", &[], "K/N"),
            ("auto", &[], "SLURM_ARRAY_TASK_ID"),
            ("auto", &kubernetes, "auto/N"),
            ("auto/16", &kubernetes, "17 of 16"),
            ("auto/16", &[("JOB_COMPLETION_INDEX", "two")], "\"two\""),
            ("auto/16", &[("HQ_TASK_ID", "0")], "HQ_TASK_ID"),
        ];
        for (text, set, part) in cases {
            let sentence = of(text, set).expect_err(text);
            assert!(sentence.contains(part), "{text}: {sentence}");
        }
    }
}
