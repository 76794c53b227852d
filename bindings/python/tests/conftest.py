"""What the tests share: a context, frames of the host with a person in it, real recordings if present."""

import os
from pathlib import Path

import numpy as np
import pytest

import vfit

ROOT = Path(__file__).resolve().parents[3]
INTRINSICS = vfit.Intrinsics(fx=120.0, fy=120.0, cx=79.5, cy=59.5)


@pytest.fixture
def ctx():
    with vfit.Context() as context:
        yield context


@pytest.fixture
def images():
    """160 x 120 pixels of a box person 2 m away, and its user map."""
    depth = np.full((120, 160), 3000, np.uint16)
    users = np.zeros((120, 160), np.uint8)
    depth[10:110, 65:95] = 2000
    users[10:110, 65:95] = 1
    return depth, users


@pytest.fixture
def frame(ctx, images):
    depth, users = images
    return vfit.Frame.from_numpy(ctx, depth, INTRINSICS, users=users)


@pytest.fixture
def standing():
    """The paper's 15 joints of someone 1.7 m tall in a T-pose, world space, 2 m before the camera."""
    z = -2.0
    return {
        "HEAD": (0, 1.60, z),
        "NECK": (0, 1.42, z),
        "TORSO": (0, 1.15, z),
        "LEFT_SHOULDER": (0.18, 1.38, z),
        "RIGHT_SHOULDER": (-0.18, 1.38, z),
        "LEFT_ELBOW": (0.46, 1.38, z),
        "RIGHT_ELBOW": (-0.46, 1.38, z),
        "LEFT_HAND": (0.75, 1.38, z),
        "RIGHT_HAND": (-0.75, 1.38, z),
        "LEFT_HIP": (0.10, 0.90, z),
        "RIGHT_HIP": (-0.10, 0.90, z),
        "LEFT_KNEE": (0.10, 0.50, z),
        "RIGHT_KNEE": (-0.10, 0.50, z),
        "LEFT_FOOT": (0.10, 0.08, z),
        "RIGHT_FOOT": (-0.10, 0.08, z),
    }


@pytest.fixture(scope="session")
def recordings():
    """Folders of real recordings."""
    shared = Path(os.environ.get("VFIT_SHARED", ROOT.parent / "shared"))
    folders = sorted((shared / "data" / "recordings").glob("*/camera.json"))
    if not folders:
        pytest.skip(f"real recordings are absent: {shared / 'data' / 'recordings'}")
    return [file.parent for file in folders]
