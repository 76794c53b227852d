"""Depth images of a person in a room: one ray a pixel, a z-buffer, and the errors of a time-of-flight camera.

Nothing here is shared with vfit's own renderer and sensor models.
"""

import numpy as np

# Axial noise: 1.5 mm at 1 m, growing with the square of the distance, within what Toelgyessy et al. 2021
# (Azure Kinect) and Wasenmueller and Stricker 2016 (Kinect v2) report, rather above it beyond 3 m.
NOISE_FLOOR_M, NOISE_AT_1M = 0.0005, 0.001
GRAZING = 0.17  # cosine of the angle to the ray below which nothing comes back: 80 degrees
EDGE_M = 0.10  # a step in depth between two pixels that is an edge
HOLES, FLYING = 0.3, 0.4  # of the pixels at an edge: without reading; mixed from both sides
DROPPED = 0.001  # of all pixels


class Camera:
    """A pinhole camera above the origin that looks along -Z, where people stand; a positive tilt looks down.

    Camera space is vfit's: x right, y down, z ahead.
    """

    def __init__(self, width, height, focal, height_m, tilt_deg, roll_deg=0.0):
        self.width, self.height, self.focal = width, height, focal
        self.cx, self.cy = 0.5 * (width - 1), 0.5 * (height - 1)
        self.height_m = height_m
        t, r = np.radians(tilt_deg), np.radians(roll_deg)
        level = np.diag([1.0, -1.0, -1.0])
        tilt = np.array([[1, 0, 0], [0, np.cos(t), -np.sin(t)], [0, np.sin(t), np.cos(t)]])
        roll = np.array([[np.cos(r), np.sin(r), 0], [-np.sin(r), np.cos(r), 0], [0, 0, 1]])
        self.rotation = roll @ tilt @ level

    def to_camera(self, points):
        return (points - np.array([0, self.height_m, 0])) @ self.rotation.T

    def rays(self):
        """Directions (height, width, 3) in world space with one metre along the optical axis."""
        u, v = np.meshgrid(np.arange(self.width), np.arange(self.height))
        seen = np.stack([(u - self.cx) / self.focal, (v - self.cy) / self.focal, np.ones_like(u)], -1)
        return seen @ self.rotation


def rasterise(points, faces, camera):
    """Inverse depth (height, width) of the nearest triangle on each pixel's ray; 0: none."""
    z = points[:, 2]
    safe = np.maximum(z, 1e-6)
    u, v = camera.focal * points[:, 0] / safe + camera.cx, camera.focal * points[:, 1] / safe + camera.cy
    out = np.zeros(camera.width * camera.height)
    faces = faces[(z[faces] > 0.1).all(1)]
    fu, fv = u[faces], v[faces]
    x0, x1 = np.maximum(np.ceil(fu.min(1)), 0), np.minimum(np.floor(fu.max(1)), camera.width - 1)
    y0, y1 = np.maximum(np.ceil(fv.min(1)), 0), np.minimum(np.floor(fv.max(1)), camera.height - 1)
    area = (fu[:, 1] - fu[:, 0]) * (fv[:, 2] - fv[:, 0]) - (fu[:, 2] - fu[:, 0]) * (fv[:, 1] - fv[:, 0])
    hit = (x1 >= x0) & (y1 >= y0) & (np.abs(area) > 1e-12)
    fu, fv, area, inverse = fu[hit], fv[hit], area[hit], 1.0 / z[faces[hit]]
    x0, y0 = x0[hit].astype(np.int64), y0[hit].astype(np.int64)
    columns = x1[hit].astype(np.int64) - x0 + 1
    count = columns * (y1[hit].astype(np.int64) - y0 + 1)
    face = np.repeat(np.arange(len(count)), count)
    place = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    px, py = x0[face] + place % columns[face], y0[face] + place // columns[face]
    # The position in the triangle, linear in the image; so is the inverse of the depth.
    du, dv = fu[face] - px[:, None], fv[face] - py[:, None]
    b0 = (du[:, 1] * dv[:, 2] - du[:, 2] * dv[:, 1]) / area[face]
    b1 = (du[:, 2] * dv[:, 0] - du[:, 0] * dv[:, 2]) / area[face]
    b2 = 1.0 - b0 - b1
    inside = (b0 >= 0) & (b1 >= 0) & (b2 >= 0)
    b = np.stack([b0, b1, b2], 1)[inside]
    np.maximum.at(out, py[inside] * camera.width + px[inside], (b * inverse[face[inside]]).sum(1))
    return out.reshape(camera.height, camera.width)


def room_depth(camera, wall_m, side_m):
    """Depth (height, width) of the empty room: the floor, a wall behind and one on the image's left."""
    rays = camera.rays()
    with np.errstate(divide="ignore", invalid="ignore"):
        floor = np.where(rays[..., 1] < 0, -camera.height_m / rays[..., 1], np.inf)
        wall = np.where(rays[..., 2] < 0, -wall_m / rays[..., 2], np.inf)
        side = np.where(rays[..., 0] < 0, -side_m / rays[..., 0], np.inf)
    return np.minimum(np.minimum(floor, wall), side)


def see(points, faces, camera, room):
    """Depth (height, width) in metres of the person (world space) in the room."""
    inverse = rasterise(camera.to_camera(points), faces, camera)
    return np.minimum(room, 1.0 / np.maximum(inverse, 1e-9))


def sense(depth_m, focal, rng):
    """What a time-of-flight camera makes of it: 16-bit millimetres, 0 without a reading."""
    z = depth_m.copy()
    dy, dx = np.gradient(depth_m)
    step = np.zeros_like(z)
    other = z.copy()  # the neighbour across the largest step
    for axis in (0, 1):
        for way in (1, -1):
            beside = np.roll(depth_m, way, axis)
            larger = np.abs(beside - depth_m) > step
            step = np.where(larger, np.abs(beside - depth_m), step)
            other = np.where(larger, beside, other)
    edge = (step > EDGE_M) & np.isfinite(step)
    slope = np.hypot(dx, dy) * focal / z
    grazing = ~edge & (slope * GRAZING > 1.0)  # close to the tangent of the angle, for small cosines
    draw, share = rng.random(z.shape), rng.random(z.shape)
    mixed = edge & (draw > HOLES) & (draw < HOLES + FLYING)
    z = np.where(mixed, z + share * (other - z), z)
    z = z + rng.normal(size=z.shape) * (NOISE_FLOOR_M + NOISE_AT_1M * z * z)
    holes = edge & (draw < HOLES) | grazing | (rng.random(z.shape) < DROPPED) | ~np.isfinite(z)
    return np.where(holes, 0, np.clip(np.round(1000 * np.nan_to_num(z)), 0, 65535)).astype(np.uint16)
