"""Crops hold people, labelled where they are, the same ones every time."""

import struct
import subprocess
import sys
import unittest

SIDE, JOINTS, COUNT = 128, 23, 96
TORSO, NOBODY = 2, 32767
RECORD = struct.Struct(f"<{SIDE * SIDE}h{3 * JOINTS}f{JOINTS}f2f")
command, body = sys.argv.pop(1), sys.argv.pop(1)


def crops(seed, first, count):
    made = subprocess.run(
        [command, body, str(seed), str(first), str(count)], check=True, stdout=subprocess.PIPE
    ).stdout
    assert len(made) == count * RECORD.size, len(made)
    return made


class Crops(unittest.TestCase):
    def test_everything_follows_from_seed_and_number(self):
        made = crops(7, 0, 8)
        self.assertEqual(made, crops(7, 0, 8))
        self.assertNotEqual(made, crops(8, 0, 8))
        self.assertEqual(made[5 * RECORD.size :], crops(7, 5, 3))

    def test_people_are_where_their_labels_say(self):
        people = near = from_the_side = 0
        for values in RECORD.iter_unpack(crops(11, 0, COUNT)):
            picture, joints, (yaw, person) = (
                values[: SIDE * SIDE],
                values[SIDE * SIDE : -2 - JOINTS],
                values[-2:],
            )
            self.assertTrue(any(z != NOBODY for z in picture))
            if not person:
                continue
            people += 1
            from_the_side += 50 < abs(yaw) * 57.3 < 130
            x, y, z = joints[3 * TORSO : 3 * TORSO + 3]
            column, row = int((x + 1) * SIDE / 2), int((y + 1) * SIDE / 2)
            seen = [
                picture[r * SIDE + c] / 32767
                for r in range(max(0, row - 5), min(SIDE, row + 6))
                for c in range(max(0, column - 5), min(SIDE, column + 6))
            ]
            near += any(abs(s - z) < 0.3 for s in seen)
        self.assertGreater(people, 0.8 * COUNT)
        self.assertLess(people, COUNT + 1)
        self.assertGreater(near, 0.9 * people)
        self.assertGreater(from_the_side, 0.2 * people)


if __name__ == "__main__":
    unittest.main()
