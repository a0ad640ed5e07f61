#!/usr/bin/env python3
"""Writes steps.json beside this file: imagined steps made by Box2D itself.

    pip install box2d==2.3.10
    python3 steps.py

In every step there is a new world: walls as chains of edges on one static body, agents and objects with friction joints, and a
distance joint for each grip. The first agent grabs or releases first.
"""

import json
import math
import pathlib
import random
import struct

from Box2D import b2CircleShape, b2FixtureDef, b2PolygonShape, b2World

SIZES = [0.8, 1.2, 1.6, 1.01]
STRENGTHS = [150, 300, 450, 600]
# Lengths of the walls at the top, left, bottom and right.
LAYOUTS = {0: (0, 0, 0, 0), 2: (10, 5, 0, 0), 4: (10, 7.5, 0, 0), 7: (10, 5, 5, 0), 10: (7.5, 10, 5, 0), 14: (10, 7.5, 7.5, 0),
           16: (10, 5, 5, 5), 19: (10, 7.5, 7.5, 5), 21: (10, 7.5, 7.5, 7.5)}
DIRECTIONS = [(0, 1), (-1, 0), (0, -1), (1, 0)]
SIDES = [(0, 1), (0, -1), (1, 0), (-1, 0)]
PUSHES = {"up": (0, 1), "down": (0, -1), "left": (-1, 0), "right": (1, 0), "upleft": (-0.707, 0.707),
          "upright": (0.707, 0.707), "downleft": (-0.707, -0.707), "downright": (0.707, -0.707)}
ACTIONS = ["turnleft", "turnright", *PUSHES, "stop", "noforce", "attach", "detach"]


def single(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def world_of(scene, bodies, grips):
    world = b2World(gravity=(0, 0), doSleep=True)
    walls = world.CreateStaticBody(position=(16, 12))
    walls.CreateEdgeChain([(-10, 10), (10, 10), (10, -10), (-10, -10), (-10, 10)])
    for (x, y), length in zip(DIRECTIONS, LAYOUTS[scene["base"]]):
        if length:
            walls.CreateEdgeChain([(0, 0), (x * length, y * length)])
    ground = world.CreateStaticBody(position=(16, 12), shapes=b2PolygonShape(box=(20, 20)))
    made = []
    for index, (x, y, angle, vx, vy, spin) in enumerate(bodies):
        r = SIZES[scene["sizes"][index]]
        if index < 2:
            shape = b2PolygonShape(vertices=[(-1.5 * r, -r), (-0.5 * r, r), (0.5 * r, r), (1.5 * r, -r)])
        else:
            shape, angle, spin = b2CircleShape(radius=r), 0.0, 0.0
        body = world.CreateDynamicBody(position=(x, y), angle=angle,
                                       fixtures=b2FixtureDef(shape=shape, density=1, friction=0, restitution=0))
        body.linearVelocity, body.angularVelocity = (vx, vy), spin
        world.CreateFrictionJoint(bodyA=ground, bodyB=body, localAnchorA=(x - 16, y - 12), localAnchorB=(0, 0), maxForce=100,
                                  maxTorque=0)
        made.append(body)
    joints = [None, None]
    for agent, held in enumerate(grips):
        if held is not None:
            a, b = made[agent], made[2 + held]
            joints[agent] = world.CreateDistanceJoint(bodyA=a, bodyB=b, anchorA=a.position, anchorB=b.position,
                                                      frequencyHz=100, dampingRatio=0.5)
    return world, made, joints


def grab(scene, world, made, agent, bodies):
    r = SIZES[scene["sizes"][agent]]
    nearest = None
    for k in range(2):
        for side in SIDES:
            hand = made[agent].GetWorldPoint((side[0] * r, side[1] * r))
            far = math.hypot(hand[0] - bodies[2 + k][0], hand[1] - bodies[2 + k][1])
            if far < SIZES[scene["sizes"][2 + k]] + 0.5 and (nearest is None or far < nearest[0]):
                nearest = far, k, side
    if nearest is None:
        return None, None
    _, k, side = nearest
    reach = r + SIZES[scene["sizes"][2 + k]]
    a, b = made[agent], made[2 + k]
    anchor = (side[0] * reach, side[1] * reach)
    return k, world.CreateWeldJoint(bodyA=a, bodyB=b, localAnchorA=anchor, localAnchorB=(0, 0), referenceAngle=b.angle - a.angle)


def step(scene, bodies, grips, actions):
    world, made, joints = world_of(scene, bodies, grips)
    grips = list(grips)
    for agent, action in enumerate(actions):
        if action == "attach" and grips[agent] is None:
            grips[agent], joints[agent] = grab(scene, world, made, agent, bodies)
        elif action == "detach" and grips[agent] is not None:
            world.DestroyJoint(joints[agent])
            grips[agent] = None
    for _ in range(5):
        for agent, action in enumerate(actions):
            body, r = made[agent], SIZES[scene["sizes"][agent]]
            if action == "stop":
                body.linearVelocity = (0, 0)
            elif action in ("turnleft", "turnright"):
                body.ApplyTorque(300 * (r / 0.8) ** 2 * (1 if action == "turnleft" else -1), True)
            elif action in PUSHES:
                force = [part * STRENGTHS[scene["strengths"][agent]] for part in PUSHES[action]]
                body.ApplyForce(body.GetWorldVector(force), body.GetWorldPoint((0, 0)), True)
        world.Step(1 / 60.0, 10, 10)
    for agent in range(2):
        made[agent].angularVelocity = 0
    return [[*body.position, body.angle, *body.linearVelocity, body.angularVelocity] for body in made], grips


def main():
    draw = random.Random(7)
    cases = []
    for n in range(40):
        scene = {"base": draw.choice(list(LAYOUTS)), "sizes": [draw.randrange(4) for _ in range(4)],
                 "strengths": [draw.randrange(4) for _ in range(2)]}
        middle = (16, 12) if n % 3 else (draw.choice([8, 24]), draw.choice([4, 20]))
        fast = 30 if n % 2 else 0
        bodies = []
        for index in range(4):
            x, y = (single(min(c + 9.2, max(c - 9.2, m + draw.uniform(-3, 3)))) for c, m in zip((16, 12), middle))
            angle = single(draw.uniform(-8, 8)) if index < 2 else 0.0
            bodies.append([x, y, angle, single(draw.uniform(-fast, fast)), single(draw.uniform(-fast, fast)), 0.0])
        grips = [draw.randrange(2) if n % 2 else None, draw.randrange(2) if n % 4 == 3 else None]
        case = {"scene": scene, "bodies": bodies, "grips": grips, "steps": []}
        for _ in range(4):
            actions = [draw.choice(ACTIONS), draw.choice(ACTIONS)]
            bodies, grips = step(scene, bodies, grips, actions)
            case["steps"].append({"actions": actions, "bodies": bodies, "grips": grips})
        cases.append(case)
    path = pathlib.Path(__file__).with_name("steps.json")
    path.write_text(json.dumps({"cases": cases}, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
