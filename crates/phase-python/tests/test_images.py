"""Observations as pictures."""

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import parallel_api_test

import phase_events as phase
from phase_events.env import PhaseEnv, PhaseParallelEnv
from phase_events.vector import PhaseVectorEnv

views = pytest.mark.parametrize("observation", ["image", "state_image"])


@pytest.mark.filterwarnings("ignore:.*spec.*:UserWarning")
@views
def test_conformance(observation):
    env = PhaseEnv(partner="random", observation=observation, image_side=84, render_mode="rgb_array")
    check_env(env)
    assert env.observation_space.shape == (84, 84, 3) and env.observation_space.dtype == np.uint8
    parallel_api_test(PhaseParallelEnv(observation=observation), num_cycles=120)


@views
@pytest.mark.parametrize("autoreset", ["next_step", "same_step"])
def test_many_are_as_one(observation, autoreset):
    """Also after the end of an episode, and for both agents."""
    given = {"observation": observation, "max_steps": 3}
    for agent in (0, 1):
        many = PhaseVectorEnv(10, "chasing", agent=agent, partner="random", autoreset=autoreset, threads=2, **given)
        alone = PhaseEnv("chasing", agent=agent, partner="random", **given)
        assert np.array_equal(many.reset(seed=5)[0][0], alone.reset(seed=5)[0])
        assert many.observation_space.shape == (10, 64, 64, 3)
        for step in range(1, 8):
            found = many.step(np.full(10, 2))
            ended = alone._arena.truncated
            if ended and autoreset == "next_step":
                wanted = alone.reset()[0]
            else:
                wanted, *_, truncated, _ = alone.step(2)
                if truncated and autoreset == "same_step":
                    assert np.array_equal(found[4]["final_obs"][0], wanted)
                    wanted = alone.reset()[0]
            assert np.array_equal(found[0][0], wanted), step
    both = PhaseVectorEnv(2, "chasing", **given)
    parallel = PhaseParallelEnv("chasing", **given)
    pictures, apart = both.reset(seed=5)[0], parallel.reset(seed=5)[0]
    assert np.array_equal(pictures[0], apart["agent_0"]) and np.array_equal(pictures[1], apart["agent_1"])


def colours(scene):
    """The colours of the bodies, where nothing else is drawn: in the middle of each (agents look ahead with their eyes)."""
    env = PhaseParallelEnv(scene, render_mode="rgb_array", side=480)
    env.reset()
    picture = env.render()
    return [picture[int(20 + 22 * (22 - y)), int(20 + 22 * (x - 6))] for x, y in env.state()[:, :2] if x or y]


def shown(picture, colour):
    return bool((picture == colour).all(axis=-1).any())


def test_pictures_show_what_is_observed_and_nothing_else():
    hidden = seen = 0
    for seed in range(25):
        scene = phase.sample_scene(seed=seed)
        body_colours = colours(scene)
        pictures, _ = PhaseParallelEnv(scene, observation="image", image_side=240).reset()
        whole, _ = PhaseParallelEnv(scene, observation="state_image", image_side=240).reset()
        vectors, _ = PhaseParallelEnv(scene).reset()
        for k, agent in enumerate(pictures):
            entities = phase.split_observation(vectors[agent])["entities"]
            order = [k, 1 - k, 2, 3]
            for place, entity in enumerate(order[: len(body_colours)]):
                observed = bool(entities[place, 1])
                # Landmarks may have the colour of a body, so a body is looked for where it is.
                x, y = PhaseParallelEnv.state(_reset(scene))[entity, :2]
                row, column = int(10 + 11 * (22 - y)), int(10 + 11 * (x - 6))
                assert (whole[agent][row, column] == body_colours[entity]).all()
                assert (pictures[agent][row, column] == body_colours[entity]).all() == observed, (seed, agent, entity)
                hidden, seen = hidden + (not observed), seen + observed
    assert hidden > 15 and seen > 60


def _reset(scene):
    env = PhaseParallelEnv(scene)
    env.reset()
    return env


@views
def test_pictures_are_saved_and_belong_to_the_caller(observation):
    env = PhaseVectorEnv(2, "helping", agent=0, partner="random", observation=observation)
    first, _ = env.reset(seed=1)
    kept, state = first.copy(), env.get_state()
    for _ in range(6):
        later = env.step(np.array([2, 2]))[0]
    assert np.array_equal(first, kept) and not np.array_equal(later, kept)
    assert np.array_equal(env.set_state(state)[0], kept)


def test_a_mind_is_a_partner_all_the_same():
    """Partners read vectors, whatever learners are shown."""
    mind = phase.Mind(parameters={"simulations": 20, "particles": 5})
    pictures = PhaseEnv("helping", partner=mind, observation="image")
    vectors = PhaseEnv("helping", partner=mind)
    pictures.reset(seed=2), vectors.reset(seed=2)
    for action in (2, 3, 4):
        assert pictures.step(action)[4] == vectors.step(action)[4]


def test_rubbish_is_refused(scene):
    for wrong in (63, 2001, 64.0, None, "64", True):
        with pytest.raises(phase.PhaseError, match="image_side"):
            PhaseEnv(scene, observation="image", image_side=wrong)
    with pytest.raises(phase.PhaseError, match="observation must be one of view, state, image, state_image, not 'picture'"):
        PhaseVectorEnv(2, scene, observation="picture")
