//! SHA-256 over the raw bits of plain data.

use phase_model::{Entity, PhysicsConfig, State};
use sha2::{Digest as _, Sha256};

/// A digest that is updated with each value added. The order matters; lengths are included.
#[derive(Clone, Debug, Default)]
pub struct Digest(Sha256);

impl Digest {
    /// The digest of no values.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an integer.
    pub fn integer(&mut self, number: u64) {
        self.0.update(number.to_le_bytes());
    }

    /// Adds the bits of a single-precision number; 0 and −0 differ.
    pub fn float(&mut self, number: f32) {
        self.0.update(number.to_bits().to_le_bytes());
    }

    /// Adds the bits of a double-precision number; 0 and −0 differ.
    pub fn double(&mut self, number: f64) {
        self.0.update(number.to_bits().to_le_bytes());
    }

    /// Adds bytes and their count.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.integer(bytes.len() as u64);
        self.0.update(bytes);
    }

    /// Adds a string.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Adds the bodies present in a state, the grips, and the contacts between bodies.
    pub fn state(&mut self, physics: &PhysicsConfig, state: &State) {
        let entities: Vec<Entity> = physics.entities().collect();
        for &entity in &entities {
            let body = state.body(entity);
            let [position, velocity] = [body.position, body.velocity];
            for number in [position.x, position.y, velocity.x, velocity.y, body.angle, body.angular_velocity]
            {
                self.float(number);
            }
        }
        for grip in &state.grips {
            self.integer(u64::from(grip.is_some()));
            if let Some(grip) = grip {
                self.integer(Entity::Object(grip.object).index() as u64);
                self.integer(grip.side as u64);
                self.float(grip.relative_angle);
            }
        }
        for (k, &a) in entities.iter().enumerate() {
            for &b in &entities[k + 1..] {
                self.integer(u64::from(state.contacts.touching(a, b)));
            }
        }
    }

    /// The digest as 64 hexadecimal digits.
    #[must_use]
    pub fn hex(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
