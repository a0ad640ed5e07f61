//! Places at which an agent misses how another moves an object, and from which its way then shows its belief.

use crate::draft::{Starts, any_room, start_in};
use phase_model::{AgentId, Body, Entity, PhysicsConfig, Scene, State, Vec2, arena::LANDMARKS};
use phase_navigation::{Field, IMPASSABLE_COST, Map, Mover, NavigationParameters, Target};
use phase_perception::{Cell, Viewpoint};
use rand::Rng;

/// The field of view of an agent that is to see nothing is that much wider (rad): bodies stray from the way.
const SPARE_ANGLE: f32 = 0.5;
/// Least distance of an agent that is to feel nothing from the side of what passes it (u).
const SPARE_WAY: f32 = 2.5;
/// A place is that much larger in each direction for an agent that is not to see it yet (u).
const SPARE_PLACE: f32 = 0.3;
/// Least approach to a place of an agent that goes there, before it sees the place (u).
const MIN_APPROACH: f32 = 2.5;
/// Starts that are drawn for agent 0 where agent 1 and the object are in good places.
const MAX_STARTS: usize = 200;
/// Distance between points on a way at which the view is tested (u).
const STRIDE: f32 = 1.0;

/// An object that agent 1 carries to another place, and agent 0, which is to miss that and then to search.
pub(crate) struct Hiding {
    physics: PhysicsConfig,
    state: State,
    map: Map,
    object: Entity,
    places: [Vec2; 2],
}

impl Hiding {
    /// The object that agent 1 of a scene wants on a landmark; `None` if it wants something else.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let goal = scene.agents[1].goal;
        let object = goal.subject();
        let (physics, state) = (scene.physics(), scene.initial_state());
        let places = [state.position(object), LANDMARKS[goal.landmark()?]];
        let map = Map::new(scene.layout);
        matches!(object, Entity::Object(_)).then_some(Self { physics, state, map, object, places })
    }

    /// Whether agent 0, as long as it stays, perceives nothing of the move. When it goes to one of the two
    /// places, it does so through another door than to the other place, and comes nearer for a while before
    /// it sees that place, and before it sees the other.
    pub(crate) fn hides(&self) -> bool {
        self.are_behind_different_doors()
            && self.places.iter().all(|&place| !self.may_see(self.here(), place, SPARE_PLACE))
            && self.is_carried_unnoticed()
            && self.is_told_by_the_way(self.places)
            && self.is_told_by_the_way([self.places[1], self.places[0]])
    }

    /// A start of agent 0 for which that [holds](Self::hides), if one of some that are drawn is such.
    pub(crate) fn draw_start(mut self, starts: Starts, random: &mut dyn Rng) -> Option<Body> {
        (0..MAX_STARTS).find_map(|_| {
            let mut start = start_in(any_room(random), random);
            start.position = starts.place(start.position);
            *self.state.body_mut(Entity::Agent(AgentId::ZERO)) = start;
            self.hides().then_some(start)
        })
    }

    /// The place where agent 0 waits.
    fn here(&self) -> Vec2 {
        self.state.position(Entity::Agent(AgentId::ZERO))
    }

    fn are_behind_different_doors(&self) -> bool {
        let width = self.physics.agents[0].width();
        let door = |to: Vec2| {
            let way = self.map.route(self.here(), to, width, self.map.gaps(), IMPASSABLE_COST)?;
            way.doors().first().map(|&(slot, _)| slot)
        };
        let doors = self.places.map(door);
        doors[0].is_some() && doors[1].is_some() && doors[0] != doors[1]
    }

    /// Whether agent 0 sees a part of the object's place, enlarged by a margin (u), from a point with a
    /// heading. Only what stays where it is hides the place: walls and the other object. Agent 1 and the
    /// object are somewhere on their way.
    fn sees_from(&self, from: Vec2, angle: f32, place: Vec2, spare: f32) -> bool {
        let mut state = self.state;
        let body = state.body_mut(Entity::Agent(AgentId::ZERO));
        (body.position, body.angle) = (from, angle);
        let moving = [Entity::Agent(AgentId::ONE), self.object];
        let view =
            moving.into_iter().fold(Viewpoint::new(&self.physics, &state, AgentId::ZERO), Viewpoint::without);
        let reach = Vec2::splat(self.physics.radius(self.object) + spare);
        Cell::in_box(place - reach, place + reach).any(|cell| view.sees_cell(cell))
    }

    /// Whether agent 0 sees a part of the place from a point once it has turned there.
    fn may_see(&self, from: Vec2, place: Vec2, spare: f32) -> bool {
        self.sees_from(from, libm::atan2f(from.x - place.x, place.y - from.y), place, spare)
    }

    fn is_carried_unnoticed(&self) -> bool {
        let [from, to] = self.places;
        let half_width = (0.5 * self.physics.agents[1].width()).max(self.physics.radius(self.object));
        let clearance = 0.5 * self.physics.agents[0].width() + half_width + SPARE_WAY;
        let angle = self.state.body(Entity::Agent(AgentId::ZERO)).angle;
        let headings = [angle - SPARE_ANGLE, angle + SPARE_ANGLE];
        let way = self.way(from, to, Mover { half_width });
        way.iter().all(|point| point.distance(self.here()) >= clearance)
            && way.into_iter().all(|point| {
                headings.iter().all(|&heading| !self.sees_from(self.here(), heading, point, 0.0))
            })
    }

    /// Whether agent 0, on its way to the first place, sees that before the other, and not too soon.
    fn is_told_by_the_way(&self, [place, other]: [Vec2; 2]) -> bool {
        let here = self.here();
        for point in self.way(here, place, Mover::of(&self.physics, Entity::Agent(AgentId::ZERO))) {
            if self.may_see(point, other, SPARE_PLACE) {
                return false;
            }
            if self.may_see(point, place, 0.0) {
                return here.distance(place) - point.distance(place) >= MIN_APPROACH;
            }
        }
        false
    }

    /// Points on the cheapest way from one place to another.
    fn way(&self, from: Vec2, to: Vec2, mover: Mover) -> Vec<Vec2> {
        let field = Field::new(&self.map, Target::Point(to), mover, &[], NavigationParameters::default());
        let mut points = vec![from];
        let mut start = from;
        for end in field.path(from) {
            let parts = (start.distance(end) / STRIDE).ceil().max(1.0);
            points.extend((1..=parts as usize).map(|part| start.lerp(end, part as f32 / parts)));
            start = end;
        }
        points
    }
}
