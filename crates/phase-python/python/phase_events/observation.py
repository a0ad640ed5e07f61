"""An agent's observation as a vector of ``OBSERVATION_SIZE`` 32-bit floats.

The vector has the parts of ``OBSERVATION_PARTS``, in order. The observing agent comes first, then the other
agent, then the objects; what is not observed is 0. Seconds are those of physics, of which a step lasts 1/12.

===========  ========  =================================================================================================
part         shape     numbers
===========  ========  =================================================================================================
entities     (4, 11)   present, observed, touched (0 or 1); x, y (u); cos and sin of the angle, the angle
                       (rad); vx, vy (u/s of physics); angular velocity (rad/s of physics)
grips        (2, 7)    of each agent: holds object 0, object 1; by its head, tail, right, left; the object's angle minus its own (rad)
contacts     (6,)      of the pairs (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3): in contact
visible      (20, 20)  cells of the arena in the field of view, from the bottom left, row by row
radii        (4,)      sizes (u); 0 for an absent object
forces       (2,)      maximum forces (100 N)
doors        (4, 2)    of each inner wall: where its door begins and ends, from the centre (u); 0, 0 without a door
attitude     (1,)      the agent's attitude: 1 helps, -1 hinders, 0 neither
own_goal     (12,)     kind (agent on landmark, object on landmark, touch), subject (as entities), landmark, one of each is 1; sign
other_goal   (12,)     the other agent's goal, as own_goal: agents know each other's goals
holds        (2,)      whether either goal holds, as far as it is observed
landmarks    (4, 2)    positions (u)
agent        (1,)      number of the agent
===========  ========  =================================================================================================
"""

import numpy as np

from ._native import OBSERVATION_PARTS, OBSERVATION_SIZE, PhaseError

_SLICES = {}
_start = 0
for _name, _shape in OBSERVATION_PARTS:
    _length = int(np.prod(_shape))
    _SLICES[_name] = (slice(_start, _start + _length), tuple(_shape))
    _start += _length


def split_observation(observation):
    """The parts of an observation by their names.

    >>> import numpy as np
    >>> split_observation(np.zeros(OBSERVATION_SIZE))["visible"].shape
    (20, 20)
    >>> split_observation(np.zeros((8, OBSERVATION_SIZE)))["radii"].shape
    (8, 4)

    Args:
        observation: (…, OBSERVATION_SIZE): one observation, or several.

    Returns:
        a dict from the names of ``OBSERVATION_PARTS`` to views of the shapes (…, *shape).

    Raises:
        PhaseError: if its last dimension is not ``OBSERVATION_SIZE`` long.
    """
    observation = np.asarray(observation)
    if observation.shape[-1:] != (OBSERVATION_SIZE,):
        raise PhaseError(f"an observation has {OBSERVATION_SIZE} numbers, not the shape {observation.shape}")
    batch = observation.shape[:-1]
    return {name: observation[..., part].reshape(batch + shape) for name, (part, shape) in _SLICES.items()}
