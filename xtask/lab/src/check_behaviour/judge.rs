//! Judges an event by the criterion of its test.

use super::rows::{BehaviourTest, Criterion, Form};
use phase_evidence::{
    Effect, GoalOutcome, Rest, Track, blocking, contact, exploration, holding, outcome,
    pursuit::Pursuit,
    search::{self, FirstLook},
    selection::{FINAL_REST_STEPS, MIN_VISIBLE_STEPS},
};
use phase_model::{AgentId, Entity, Goal, ObjectId, Scene, State, layout::room_of};
use phase_navigation::{IMPASSABLE_COST, Map};
use phase_perception::observed_set;

/// Maximum number of steps for an agent to release its object and come to rest after its goal is reached.
const SETTLING_STEPS: usize = 8;

/// The judgement of one event.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Verdict {
    /// Whether the row's criterion holds.
    pub success: bool,
    /// Whether the means named by the row was seen; `None` where the row names none.
    pub shown: Option<bool>,
    /// The outcome of the judged agent's goal.
    pub with: GoalOutcome,
    /// The outcome of that goal without the other's contribution.
    pub without: Option<GoalOutcome>,
    /// Observations in words, for people.
    pub notes: String,
}

/// Judges an event of a scene, beside its counterfactual if the part has one.
#[must_use]
pub(super) fn judge(part: &BehaviourTest, scene: &Scene, track: &Track, control: Option<&Track>) -> Verdict {
    let case = Case { part, scene, track };
    let goal = scene.agents[part.judged].goal;
    let with = GoalOutcome::of(track, goal);
    let without = control.map(|control| GoalOutcome::of(control, goal));
    let effect = without.map(|without| Effect { with, without });
    let (success, shown, notes) = match part.criterion {
        Criterion::Reach => (case.all_reached(), None, case.outcomes()),
        Criterion::Fetch => case.fetch(),
        Criterion::SearchFirst(wanted) => case.search(wanted),
        Criterion::CarryTogether => case.carry_together(goal),
        Criterion::Help => {
            let held = case.held_anything(part.judged.other());
            (
                effect.is_some_and(|effect| effect.helped()),
                Some(held >= MIN_VISIBLE_STEPS),
                format!("helper held {held}"),
            )
        }
        Criterion::StayOut => case.stay_out(with, effect),
        Criterion::Hinder(form) => {
            let (shown, notes) = case.hindrance(form, goal);
            (effect.is_some_and(|effect| effect.hindered()), Some(shown), notes)
        }
        Criterion::Chase => case.chase(effect),
        Criterion::Compete => case.compete(goal),
        Criterion::Rest => case.rest(),
        Criterion::Unseen => case.unseen(goal),
        Criterion::WrongPlace(wanted) => case.wrong_place(goal, wanted),
    };
    Verdict { success, shown, with, without, notes }
}

/// One event under judgement.
struct Case<'a> {
    part: &'a BehaviourTest,
    scene: &'a Scene,
    track: &'a Track,
}

type Assessment = (bool, Option<bool>, String);

impl Case<'_> {
    /// The agents that the row is about, with their outcomes.
    fn active(&self) -> impl Iterator<Item = (AgentId, GoalOutcome)> {
        let who = AgentId::ALL.into_iter().filter(|&agent| self.part.idle != Some(agent));
        who.map(|agent| (agent, GoalOutcome::of(self.track, self.scene.agents[agent].goal)))
    }

    fn all_reached(&self) -> bool {
        self.active().all(|(_, outcome)| outcome.reached)
    }

    fn outcomes(&self) -> String {
        let words = |(agent, outcome): (AgentId, GoalOutcome)| match outcome.steps {
            Some(steps) => format!("agent {agent} after {steps}"),
            None if outcome.reached => format!("agent {agent} in the end"),
            None => format!("agent {agent} never"),
        };
        self.active().map(words).collect::<Vec<_>>().join(", ")
    }

    fn fetch(&self) -> Assessment {
        let last = self.track.states.last();
        let held = last.is_some_and(|state| state.grips.iter().any(Option::is_some));
        let from = self.track.steps().saturating_sub(FINAL_REST_STEPS);
        let still = self.track.physics.entities().all(|it| Rest::after(self.track, it, from).is_at_rest());
        let notes = format!("{}, held at the end: {held}, still: {still}", self.outcomes());
        (self.all_reached() && !held && still, None, notes)
    }

    fn search(&self, wanted: usize) -> Assessment {
        let start = self.scene.agents[self.part.judged].start.position;
        let regions = Map::new(self.scene.layout).regions_around(room_of(start));
        let [near, larger] = &regions[..] else { return (false, None, "there are not two regions".into()) };
        let first = exploration::searched_first(self.track, self.part.judged, &[near, larger]);
        let notes = first.map_or_else(
            || "neither searched".into(),
            |(region, step)| format!("{} first, at step {step}", ["near", "larger"][region]),
        );
        (first.is_some_and(|(region, _)| region == wanted), None, format!("{notes}; {}", self.outcomes()))
    }

    fn carry_together(&self, goal: Goal) -> Assessment {
        let Some(object) = object_of(goal) else { return (false, None, String::new()) };
        let together = holding::carried_together(self.track, object);
        let shown = together.steps >= MIN_VISIBLE_STEPS && together.distance > 1.0;
        let notes = format!("together {} steps, {:.1} u", together.steps, together.distance);
        (self.all_reached() && shown, Some(shown), notes)
    }

    fn stay_out(&self, with: GoalOutcome, effect: Option<Effect>) -> Assessment {
        let helper = Entity::Agent(self.part.judged.other());
        let helpee = Entity::Agent(self.part.judged);
        let touched = contact::steps_touching(self.track, helper, helpee).len();
        let good = with.reached && touched == 0 && effect.is_some_and(|effect| !effect.hindered());
        let way = self.track.distance_travelled(helper, 0..self.track.states.len());
        (good, None, format!("touched {touched} steps, helper went {way:.1} u"))
    }

    fn hindrance(&self, form: Form, goal: Goal) -> (bool, String) {
        let hinderer = self.part.judged.other();
        let object = object_of(goal).unwrap_or(ObjectId::ZERO);
        let alone = holding::carried_alone(self.track, hinderer, object);
        match form {
            Form::Block => {
                let map = Map::new(self.scene.layout);
                let target = |state: &State| blocking::next_place(goal, state);
                let door = blocking::steps_blocking_a_door(self.track, &map, hinderer, target).len();
                let between = blocking::steps_between(self.track, hinderer, target).len();
                (
                    door.max(between) >= MIN_VISIBLE_STEPS,
                    format!("blocked a door {door} steps, between {between}"),
                )
            }
            Form::Take => {
                let away = goal.landmark().map_or(0.0, |landmark| -alone.approach[landmark]);
                let shown = alone.steps >= MIN_VISIBLE_STEPS && alone.distance > 1.0;
                (
                    shown,
                    format!("held alone {} steps, {:.1} u, {away:.1} u away", alone.steps, alone.distance),
                )
            }
            Form::Drag => {
                let both = holding::carried_together(self.track, object).steps;
                (both >= MIN_VISIBLE_STEPS, format!("both held {both} steps, hinderer alone {}", alone.steps))
            }
            Form::Hide => {
                let hidden = self.out_of_reach(self.part.judged, object);
                (hidden, format!("hidden: {hidden}, held alone {} steps", alone.steps))
            }
            Form::Undo => {
                let undone = |state: &&State| outcome::condition(&self.track.physics, state, goal);
                let steps = self.track.states.iter().filter(undone).count();
                (steps >= MIN_VISIBLE_STEPS, format!("so for {steps} steps"))
            }
            Form::Evade => {
                let flight = Pursuit::of(self.track, hinderer);
                let notes =
                    format!("away {} of {}, rooms {}", flight.away, flight.moving, flight.rooms_changed);
                (flight.moving >= MIN_VISIBLE_STEPS, notes)
            }
        }
    }

    fn chase(&self, effect: Option<Effect>) -> Assessment {
        let chaser = Pursuit::by_way(self.track, AgentId::ZERO, &Map::new(self.scene.layout));
        let fleer = Pursuit::of(self.track, AgentId::ONE);
        let chases = 2 * chaser.towards >= chaser.moving && chaser.moving >= MIN_VISIBLE_STEPS;
        let flees = effect.is_some_and(|effect| effect.hindered());
        let notes = format!(
            "chaser towards {} of {}, fleer changed rooms {} times, nearest {:.1} u",
            chaser.towards, chaser.moving, fleer.rooms_changed, chaser.nearest
        );
        (chases && flees, Some(fleer.rooms_changed > 0), notes)
    }

    fn compete(&self, goal: Goal) -> Assessment {
        let Some(object) = object_of(goal) else { return (false, None, String::new()) };
        let touched = |agent: AgentId| {
            !contact::steps_touching(self.track, Entity::Agent(agent), Entity::Object(object)).is_empty()
        };
        let engaged = touched(AgentId::ZERO) && touched(AgentId::ONE);
        let fought = holding::carried_together(self.track, object).steps;
        let decided = self.active().any(|(_, outcome)| outcome.reached);
        let notes = format!("{}, both held {fought} steps, both touched it: {engaged}", self.outcomes());
        (engaged && (decided || fought >= 5), Some(fought >= MIN_VISIBLE_STEPS), notes)
    }

    fn rest(&self) -> Assessment {
        let reached = self.active().filter_map(|(_, outcome)| outcome.steps).max();
        let (true, Some(reached)) = (self.all_reached(), reached) else {
            return (false, None, self.outcomes());
        };
        let from = reached + SETTLING_STEPS;
        let last = self.track.states.last();
        let held = last.is_some_and(|state| state.grips.iter().any(Option::is_some));
        let mut quiet = true;
        let mut notes = format!("{}, held at the end: {held}", self.outcomes());
        for entity in self.track.physics.entities() {
            let rest = Rest::after(self.track, entity, from);
            if !rest.is_at_rest() {
                quiet = false;
                let displacement = rest.displacement;
                let turned = rest.turned;
                notes += &format!("; {entity} strayed {displacement:.2} u, turned {turned:.2} rad");
            }
        }
        (quiet && !held, None, notes)
    }

    /// Whether the judged agent, once it acts, first sees the place where the object of its goal was at the
    /// start, or the object. The means is that the object was by then moved to another room, unseen by it.
    fn wrong_place(&self, goal: Goal, wanted: bool) -> Assessment {
        let waits = usize::from(self.scene.agents[self.part.judged].awareness.waits);
        let object = goal.subject();
        let is_moved = search::was_moved(self.track, object, waits);
        if !is_moved || !search::missed(self.track, self.part.judged, object, waits) {
            let what = if is_moved { "was seen" } else { "was not moved" };
            return (false, Some(false), format!("the object {what} before the agent acted"));
        }
        let look = search::first_look(self.track, self.part.judged, object, waits);
        let notes = match look {
            Some(FirstLook { step, at_old_place, approach }) => {
                let what = if at_old_place { "looked where it had been" } else { "saw it where it is" };
                format!("{what}, at step {step}, {approach:.1} u nearer")
            }
            None => "saw neither".into(),
        };
        (look.is_some_and(|look| look.at_old_place == wanted), Some(true), notes)
    }

    /// Whether the hinderer holds the object for some time, and the victim does not perceive the hinderer in
    /// most of it. Notes also tell how much of the hinderer's approach to the object is unseen.
    fn unseen(&self, goal: Goal) -> Assessment {
        let hinderer = self.part.judged.other();
        let object = object_of(goal).unwrap_or(ObjectId::ZERO);
        let physics = &self.track.physics;
        let is_unseen = |state: &&State| {
            !observed_set(physics, state, self.part.judged).contains(Entity::Agent(hinderer))
        };
        let held: Vec<&State> = self.track.states.iter().filter(|it| it.holds(hinderer, object)).collect();
        let unseen = held.iter().copied().filter(is_unseen).count();
        let first = self.track.states.iter().position(|state| state.holds(hinderer, object));
        let way = &self.track.states[..first.map_or(self.track.states.len(), |first| first + 1)];
        let distance = |state: &State| {
            state.position(Entity::Agent(hinderer)).distance(state.position(Entity::Object(object)))
        };
        let closer = |pair: &[State]| (distance(&pair[0]) - distance(&pair[1])).max(0.0);
        let approach: f32 = way.windows(2).map(closer).sum();
        let hidden: f32 = way.windows(2).filter(|pair| is_unseen(&&pair[1])).map(closer).sum();
        let first = first.map_or_else(|| "never".into(), |step| format!("from step {step}"));
        let notes = format!(
            "approached {approach:.1} u, {hidden:.1} u unseen; held {first}, {} steps, {unseen} unseen",
            held.len()
        );
        let shown = held.len() >= MIN_VISIBLE_STEPS;
        (shown && 2 * unseen > held.len(), Some(shown), notes)
    }

    fn held_anything(&self, agent: AgentId) -> usize {
        self.track.states.iter().filter(|state| state.grips[agent].is_some()).count()
    }

    /// Whether an object finally lies where an agent does not fit through the doors.
    fn out_of_reach(&self, agent: AgentId, object: ObjectId) -> bool {
        let Some(state) = self.track.states.last() else { return false };
        let map = Map::new(self.scene.layout);
        let from = state.position(Entity::Agent(agent));
        let to = state.position(Entity::Object(object));
        let width = self.track.physics.agents[agent].width();
        map.route(from, to, width, map.gaps(), IMPASSABLE_COST).is_none_or(|route| route.impassable > 0)
    }
}

const fn object_of(goal: Goal) -> Option<ObjectId> {
    match goal.subject() {
        Entity::Object(object) => Some(object),
        Entity::Agent(_) => None,
    }
}
