"""The scenes: a continuous turn, cuts between front and side, and clips seen from four sides."""

import zlib

import numpy as np

from motion import Actor
from recording import FPS, Recording
from renderer import Camera, room_depth, see, sense

TURN_FRAMES = 216  # of 360 degrees, as in vfit-bench track --only facing
CUT_FRAMES = 30  # of each view
CUTS = [("front", 0), ("side", 90), ("front", 0), ("side", -90), ("front", 0)]
CLIP_FRAMES = 60
HEADINGS = (0, 90, 180, -90)
# Width, height and focal length in pixels: Kinect v2; Azure Kinect, narrow and binned.
SENSORS = [(512, 424, 366.0), (320, 288, 252.0)]


class Person:
    """A character with a stature and a girth; `name` tells them apart and seeds what is drawn."""

    def __init__(self, name, motions, stature_m, girth):
        self.name, self.motions, self.stature_m, self.girth = name, motions, stature_m, girth

    def rng(self, scene):
        return np.random.default_rng(zlib.crc32(f"{self.name} {scene}".encode()))


class Scene:
    """One recording: a motion and, of each frame, the heading in degrees (0: to the camera) and a label."""

    def __init__(self, kind, name, person, motion, headings_deg, labels):
        self.kind, self.name, self.person, self.motion = kind, f"{kind}-{name}", person, motion
        self.headings_deg, self.labels = headings_deg, labels

    def write(self, folder):
        rng = self.person.rng(self.name)
        times = rng.uniform(0, 1) * self.motion.duration_s + np.arange(len(self.labels)) / FPS
        if self.kind == "clip":
            times -= times[0]
        actor = Actor(self.motion, times, self.person.stature_m, self.person.girth)
        camera, at, room = _place(rng, actor.top_m)
        recording = Recording(folder, camera, self.labels)
        towards = np.degrees(np.arctan2(at[0], -at[2]))  # so that heading 0 faces the camera
        stand = at
        for frame, heading in enumerate(self.headings_deg):
            turn = _about_up(heading - towards)
            if self.motion.duration_s == 0:
                at = stand + _sway(frame / FPS)
            skin = actor.skin(frame) @ turn.T + at
            depth = see(skin, actor.character.faces, camera, room)
            joints = {n: camera.to_camera(p @ turn.T + at) for n, p in actor.joints(frame).items()}
            recording.add(sense(depth, camera.focal, rng), joints)
        recording.close()


def _about_up(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def _sway(time_s):
    """Of a person who holds a pose, a few millimetres aside and ahead: what never moves is furniture."""
    return np.array([0.004 * np.sin(2.1 * time_s), 0, 0.006 * np.sin(1.4 * time_s + 1)])


def _place(rng, top_m):
    """A camera that sees a whole person of that height, 2 to 4 m away, and an empty room."""
    width, height, focal = SENSORS[rng.integers(len(SENSORS))]
    camera_m, distance_m = rng.uniform(0.8, 1.6), rng.uniform(2.2, 3.8)
    middle = np.degrees(np.arctan2(camera_m - 0.5 * top_m, distance_m))
    camera = Camera(width, height, focal, camera_m, middle + rng.uniform(-3, 3), rng.uniform(-2, 2))
    at = np.array([rng.uniform(-0.3, 0.3), 0, -distance_m])
    return camera, at, room_depth(camera, distance_m + rng.uniform(0.7, 2.0), rng.uniform(1.2, 2.2))


def _resting(person):
    """The motions to stand in: those named idle or still, or all."""
    quiet = [m for m in person.motions if any(w in m.name.lower() for w in ("idle", "still", "express"))]
    return quiet or person.motions


def scenes_of(people, clips_of_each):
    """Every scene of every person."""
    out = []
    for i, person in enumerate(people):
        rest, rng = _resting(person), person.rng("scenes")
        way = 1 if i % 2 else -1
        turn = way * np.arange(TURN_FRAMES) * 360 / TURN_FRAMES
        out.append(Scene("turn", person.name, person, rest[i % len(rest)], turn, ["turn"] * TURN_FRAMES))
        off = i % 20 - 10  # from the view exactly from a side
        headings = [deg + (off if label == "side" else 0) for label, deg in CUTS for _ in range(CUT_FRAMES)]
        labels = [label for label, _ in CUTS for _ in range(CUT_FRAMES)]
        out.append(Scene("cuts", person.name, person, rest[(i + 1) % len(rest)], headings, labels))
        moving = [m for m in person.motions if m.duration_s > 0]
        for k in range(min(clips_of_each, len(moving))):
            motion = moving[(i * clips_of_each + k) % len(moving)]
            for heading in HEADINGS:
                deg = heading + rng.uniform(-20, 20)
                out.append(
                    Scene(
                        "clip",
                        f"{person.name}-{motion.name}-{heading}",
                        person,
                        motion,
                        [deg] * CLIP_FRAMES,
                        ["clip"] * CLIP_FRAMES,
                    )
                )
    return out
