//! Impacts on walls within a substep: stop at the wall, lose the normal velocity, continue for the remaining
//! time.
//!
//! A substep of the engine uses the contacts at its start. A body that then moves onto a wall is reset to the
//! moment of impact, which the engine's own sweep test finds. There the engine resolves the contact between
//! that body and the walls, and nothing else: an impact is instantaneous compared with forces, friction and
//! other bodies. For the remaining time the body continues with its remaining velocity. So a corner that hits
//! a wall can turn the body onto its next corner within the substep, and a body pushing from behind acts from
//! the next substep on.

use crate::{
    bodies,
    contact::ContactRules,
    dynamic_body,
    dynamic_body::{DynamicBody, PoseAndVelocity},
    settings,
};
use phase_model::{Body, PhysicsConfig, Segment, Vec2, arena, arena::SUBSTEP_SECONDS};
use rapier2d::{
    parry::{
        bounding_volume::{Aabb, BoundingVolume},
        query::sweep_toi::{
            CORE_FRACTION, Sweep, SweepToiOutput, SweepToiStatus, ToiProxy, sweep_time_of_impact,
        },
    },
    prelude::*,
};

/// Maximum number of impacts of one body resolved in one substep; at a further one it loses the remaining
/// time.
const MAX_IMPACTS: usize = 6;
/// Distance of an agent's outline from a wall, or penetration depth of an object's, at which it counts as an
/// impact (u).
const IMPACT_DISTANCE: f32 = 0.005;

/// The obstacles that bodies can hit, and their construction.
#[derive(Clone, Copy)]
pub(crate) struct Impacts<'a> {
    physics: &'a PhysicsConfig,
    walls: &'a [Segment],
}

/// All walls of a scene: the four sides of the arena and the inner walls.
pub(crate) fn walls(physics: &PhysicsConfig) -> Vec<Segment> {
    let min = arena::MIN;
    let max = arena::MAX;
    let corners = [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)];
    let sides = [0, 1, 2, 3].map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] });
    let inner = physics.walls.iter().filter(|wall| wall.a.is_finite() && wall.b.is_finite());
    sides.iter().chain(inner).copied().collect()
}

impl<'a> Impacts<'a> {
    /// The impacts of a scene's bodies on its [`walls`].
    pub(crate) fn new(physics: &'a PhysicsConfig, walls: &'a [Segment]) -> Self {
        Self { physics, walls }
    }

    /// Resolves the impacts of a body on its path from `before`, at which its angle was `angle`, to its
    /// present pose.
    pub(crate) fn resolve(
        self,
        engine: &mut PhysicsWorld,
        dynamic_body: &mut DynamicBody,
        before: &PoseAndVelocity,
        mut angle: f32,
    ) {
        let mut from = before.0;
        let mut left = SUBSTEP_SECONDS;
        for impact in 1..=MAX_IMPACTS {
            let (to, velocities) = dynamic_body.motion(engine);
            let body = &engine.bodies[dynamic_body.body];
            let centre_of_mass = body.local_center_of_mass();
            let sweep = Sweep::from_poses(&from, &to, centre_of_mass);
            let Some(share) = self.first(engine.colliders[dynamic_body.collider].shape(), &sweep) else {
                return;
            };
            left = (left * (1.0 - share) - settings::IMPACT_SECONDS).max(0.0);
            angle += (dynamic_body.angle - angle) * share;
            let at = dynamic_body::pose_around(centre_of_mass, sweep.c1.lerp(sweep.c2, share), angle);
            if impact == MAX_IMPACTS {
                dynamic_body.angle = angle;
                dynamic_body.restore(engine, (at, velocities));
                return;
            }
            let (after, velocities) = self.bounce(dynamic_body, (at, velocities), angle);
            angle += dynamic_body::turn_between(&at.rotation, &after.rotation);
            from = after;
            dynamic_body.angle = angle + velocities.angvel * left;
            let centre = from * centre_of_mass + velocities.linvel * left;
            dynamic_body.restore(
                engine,
                (dynamic_body::pose_around(centre_of_mass, centre, dynamic_body.angle), velocities),
            );
        }
    }

    /// Time at which a moving shape first reaches a wall, as a share of its path.
    fn first(self, shape: &dyn Shape, sweep: &Sweep) -> Option<f32> {
        let [start, end] = [0.0, 1.0].map(|share| shape.compute_aabb(&sweep.transform_at(share)));
        let near = start.merged(&end).loosened(2.0 * IMPACT_DISTANCE);
        let mut first = 1.0;
        for wall in self.walls {
            if !near.intersects(&Aabb::new(wall.a.min(wall.b), wall.a.max(wall.b))) {
                continue;
            }
            let mut hit = time_of_impact(wall, &ToiProxy::from_shape(shape)?, sweep, first);
            if hit.status == SweepToiStatus::Overlapped {
                // A body that starts across a wall may come out on either side, but its centre stays on its
                // own side.
                let core = CORE_FRACTION * shape.ccd_thickness();
                hit = time_of_impact(wall, &ToiProxy::point(sweep.local_center, core), sweep, first);
            }
            if matches!(hit.status, SweepToiStatus::Hit | SweepToiStatus::Failed) {
                first = first.min(hit.fraction);
            }
        }
        (first < 1.0).then_some(first)
    }

    /// A body's motion after it has been separated from the walls that it touches and no longer moves into
    /// any of them.
    fn bounce(
        self,
        dynamic_body: &DynamicBody,
        (at, velocities): PoseAndVelocity,
        angle: f32,
    ) -> PoseAndVelocity {
        let mut engine = settings::impact_engine();
        bodies::insert_ground(&mut engine, &self.physics.walls);
        let start = Body {
            position: at.translation,
            velocity: velocities.linvel,
            angle,
            angular_velocity: velocities.angvel,
        };
        let (body, _) = bodies::insert_body(&mut engine, self.physics, dynamic_body.entity, &start);
        engine.step_with_events(&ContactRules::default(), &());
        let body = &engine.bodies[body];
        let gyration = body.mass_properties().local_mprops.inv_mass
            / body.mass_properties().local_mprops.inv_principal_inertia;
        let energy = |motion: RigidBodyVelocity<f32>| {
            motion.linvel.length_squared() + motion.angvel * motion.angvel * gyration
        };
        let mut after = *body.vels();
        let gain = energy(after) / energy(velocities);
        if gain > 1.0 {
            // A wall does no work, so energy gained by a body wedged between two walls is a solver error and
            // is removed.
            after = after * libm::sqrtf(1.0 / gain);
        }
        (*body.position(), after)
    }
}

/// Time at which a moving shape reaches a wall, if it does so before the share `latest` of its path.
fn time_of_impact(wall: &Segment, shape: &ToiProxy, sweep: &Sweep, latest: f32) -> SweepToiOutput {
    let ends = [wall.a, wall.b];
    let still = Sweep::constant(&Pose::IDENTITY, Vec2::ZERO);
    sweep_time_of_impact(&ToiProxy::from_points(&ends, 0.0), &still, shape, sweep, latest, IMPACT_DISTANCE)
}
