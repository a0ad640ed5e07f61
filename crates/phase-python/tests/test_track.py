"""Tracks of videos that another program draws: Pillow, from the definitions of the published style."""

import math
import pickle

import numpy as np
import pytest
from PIL import Image, ImageDraw

import phase_events as phase

SUPERSAMPLED = 4
LANDMARKS = [((8.5, 19.5), (45, 45, 180)), ((23.5, 19.5), (50, 150, 50)), ((23.5, 4.5), (180, 45, 45)), ((8.5, 4.5), (180, 180, 45))]
COLOURS = [(255, 0, 0), (0, 255, 0), (117, 216, 230), (255, 153, 153)]
EDGES = [[(6, 2), (26, 2)], [(26, 2), (26, 22)], [(26, 22), (6, 22)], [(6, 22), (6, 2)]]


def draw(event, bodies, *, width=640, height=480, scale=20, eyes=True):
    """A frame with the arena in its middle; ``bodies`` has x, y (u) and the angle (rad) of each."""
    fine = SUPERSAMPLED * scale
    image = Image.new("RGB", (SUPERSAMPLED * width, SUPERSAMPLED * height), "white")
    pen = ImageDraw.Draw(image)
    left, top = (SUPERSAMPLED * side / 2 - 10 * fine for side in (width, height))

    def at(x, y):
        return left + (x - 6) * fine, top + (22 - y) * fine

    def box(x, y, half_width, half_height, colour):
        (x0, y0), (x1, y1) = at(x - half_width, y + half_height), at(x + half_width, y - half_height)
        pen.rectangle([x0, y0, x1 - 1, y1 - 1], fill=colour)

    def disc(x, y, radius, colour):
        (x0, y0), (x1, y1) = at(x - radius, y + radius), at(x + radius, y - radius)
        pen.ellipse([x0, y0, x1 - 1, y1 - 1], fill=colour)

    for (x, y), colour in LANDMARKS:
        box(x, y, 2.5, 2.5, colour)
    for (x0, y0), (x1, y1) in [*EDGES, *event.observed.walls.tolist()]:
        box((x0 + x1) / 2, (y0 + y1) / 2, abs(x1 - x0) / 2 + 0.125, abs(y1 - y0) / 2 + 0.125, "black")
    for (x, y, angle), radius, colour in zip(bodies[:2], event.observed.radii, COLOURS):
        cos, sin = math.cos(angle) * radius, math.sin(angle) * radius

        def place(right, ahead):
            return x + cos * right - sin * ahead, y + sin * right + cos * ahead

        pen.polygon([at(*place(*corner)) for corner in [(-1.5, -1), (-0.5, 1), (0.5, 1), (1.5, -1)]], fill=colour)
        for side in (-0.5, 0.5) if eyes else ():
            disc(*place(side, 0.5), 0.335 * radius, "black")
            disc(*place(side, 0.5), 0.291 * radius, "white")
            disc(*place(side, 0.7), 0.224 * radius, "black")
    for (x, y, _), radius, colour in zip(bodies[2:], event.observed.radii[2:], COLOURS[2:]):
        disc(x, y, radius, colour)
    return np.asarray(image.resize((width, height), Image.BOX))


@pytest.mark.parametrize(
    ("style", "place", "degrees"),
    [({}, 0.1, 3), ({"width": 320, "height": 240, "scale": 10}, 0.15, 6), ({"eyes": False, "width": 400, "height": 425}, 0.1, 3)],
)
def test_what_pillow_draws_is_read(event, style, place, degrees):
    """Bodies go straight from row to row, at 20 frames a second, for four seconds."""
    rows = event.observed.trajectory[:17, :, [0, 1, 4]]
    shown = [rows[k // 5] + (rows[min(k // 5 + 1, 16)] - rows[k // 5]) * (k % 5) / 5 for k in range(81)]
    seen = phase.track(np.stack([draw(event, bodies, **style) for bodies in shown]), frame_rate=20)
    assert np.array_equal(seen.walls, event.observed.walls)
    assert list(seen.size_levels) == list(event.observed.size_levels)
    assert seen.not_judged == []
    found = seen.trajectory[:, :, [0, 1, 4]]
    assert len(found) == 17
    off = np.linalg.norm(found[..., :2] - rows[..., :2], axis=-1)
    assert np.median(off) < 0.03 and off.max() < place, (np.median(off), off.max())
    turned = np.angle(np.exp(1j * (found[:, :2, 2] - rows[:, :2, 2])))
    assert np.degrees(np.abs(turned)).max() < degrees, np.degrees(np.abs(turned)).max()


def test_shapes_without_an_arena_are_followed(tmp_path):
    """Three squares on a dark ground: the one that is named first is agent 0, and no goal names a landmark."""
    folder = tmp_path / "film"
    folder.mkdir()
    colours = [(250, 220, 120), (240, 90, 90), (120, 220, 250)]
    for frame in range(60):
        image = Image.new("RGB", (320, 200), (24, 28, 40))
        pen = ImageDraw.Draw(image)
        for k, colour in enumerate(colours):
            x, y = 60 + 3 * frame * (k > 0) + 20 * (k == 2), 40 + 60 * k + (frame if k == 0 else 0)
            pen.rectangle([x - 12, y - 12, x + 12, y + 12], fill=colour)
        image.save(folder / f"{frame:03}.png")
    seen = phase.track(folder, frame_rate=20, map="#fadc78,#78dcfa,#f05a5a")
    assert seen.trajectory.shape == (12, 3, 5)
    # Agent 0 goes down and its x stays; agent 1 goes to the right.
    moved = seen.trajectory[-1, :, :2] - seen.trajectory[0, :, :2]
    assert moved[0, 1] < -1 and abs(moved[0, 0]) < 0.05 and moved[1, 0] > 5 and abs(moved[1, 1]) < 0.05
    assert any("landmarks" in sentence for sentence in seen.not_judged)
    assert pickle.loads(pickle.dumps(seen)).not_judged == seen.not_judged
    goals = phase.infer(seen, method="intent-network")["goals"][0]
    assert goals and not any("landmark" in goal["goal"]["kind"] for goal in goals)
    with pytest.raises(phase.PhaseError, match="number 4"):
        phase.track(folder, map="4,1")
