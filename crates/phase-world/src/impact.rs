//! Impacts on walls within a substep: stop at the wall, lose the speed into it, go on for the time left.
//!
//! A substep of the engine knows the contacts of its start. What then moves onto a wall is put back to the
//! moment at which it reached it, which the engine's own sweep test finds. There the engine resolves the
//! contact between that body and the walls, and nothing else: an impact is over before forces, friction or
//! other bodies count. For the time left the body goes on with what velocity remains. So a corner that lands
//! can turn the body onto its next corner within the substep, and what pushes from behind does so from the
//! next substep on.

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

/// Impacts of one body that are played out in one substep; at the next it loses the time left.
const MAX_IMPACTS: usize = 6;
/// Distance of an agent's outline from a wall, or depth of an object's in it, at which it has hit (u).
const IMPACT_DISTANCE: f32 = 0.005;

/// What bodies can hit, and how they are made.
#[derive(Clone, Copy)]
pub(crate) struct Impacts<'a> {
    physics: &'a PhysicsConfig,
    walls: &'a [Segment],
}

/// All walls of a scene: the four sides of the arena and the inner walls.
pub(crate) fn walls(physics: &PhysicsConfig) -> Vec<Segment> {
    let (min, max) = (arena::MIN, arena::MAX);
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

    /// Plays out the impacts of a body on its way from `before`, at which its angle was `angle`, to where it
    /// is now.
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

    /// When on its way a shape first reaches a wall, as a share of the way.
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
                // What starts across a wall may come out on either side, but its middle stays on its own.
                let core = CORE_FRACTION * shape.ccd_thickness();
                hit = time_of_impact(wall, &ToiProxy::point(sweep.local_center, core), sweep, first);
            }
            if matches!(hit.status, SweepToiStatus::Hit | SweepToiStatus::Failed) {
                first = first.min(hit.fraction);
            }
        }
        (first < 1.0).then_some(first)
    }

    /// A body's motion once it has been parted from the walls that it touches and moves into none of them.
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
            // A wall does no work, so energy gained by a body wedged between two walls is a solver error and is
            // removed.
            after = after * libm::sqrtf(1.0 / gain);
        }
        (*body.position(), after)
    }
}

/// When a shape on its way reaches a wall, if it does so before the share `latest` of it.
fn time_of_impact(wall: &Segment, shape: &ToiProxy, sweep: &Sweep, latest: f32) -> SweepToiOutput {
    let ends = [wall.a, wall.b];
    let still = Sweep::constant(&Pose::IDENTITY, Vec2::ZERO);
    sweep_time_of_impact(&ToiProxy::from_points(&ends, 0.0), &still, shape, sweep, latest, IMPACT_DISTANCE)
}
