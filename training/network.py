"""The skeleton network: a crop of one person's depth in, heat maps and depth maps of the joints out.

Plain 3 x 3 convolutions throughout: on a CPU they beat separable ones of fewer operations.
"""

import torch
from torch import nn

JOINTS = [
    "HEAD",
    "NECK",
    "TORSO",
    "LEFT_SHOULDER",
    "RIGHT_SHOULDER",
    "LEFT_ELBOW",
    "RIGHT_ELBOW",
    "LEFT_HAND",
    "RIGHT_HAND",
    "LEFT_HIP",
    "RIGHT_HIP",
    "LEFT_KNEE",
    "RIGHT_KNEE",
    "LEFT_FOOT",
    "RIGHT_FOOT",
    "PELVIS",
    "CHEST",
    "LEFT_CLAVICLE",
    "RIGHT_CLAVICLE",
    "LEFT_WRIST",
    "RIGHT_WRIST",
    "LEFT_TOES",
    "RIGHT_TOES",
]
COUNT = len(JOINTS)
MIRROR = [JOINTS.index(n.replace("LEFT", "x").replace("RIGHT", "LEFT").replace("x", "RIGHT")) for n in JOINTS]
CROP, MAP = 128, 32


def convolution(inputs, outputs, stride=1, size=3):
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class Deeper(nn.Module):
    """One convolution more, beside a way past it. It starts as no change: a trained network can grow."""

    def __init__(self, channels):
        super().__init__()
        self.more = nn.Sequential(
            nn.Conv2d(channels, channels, 3, padding=1, bias=False), nn.BatchNorm2d(channels)
        )
        nn.init.zeros_(self.more[1].weight)

    def forward(self, x):
        return torch.relu(x + self.more(x))


class Network(nn.Module):
    """[n, 1, 128, 128] -> maps [n, 2 * COUNT, 32, 32] (heat logits, then depth) and logits [n, 2]:
    faces away, is a person."""

    def __init__(self, stages=(24, 48, 96, 128), fine=32):
        super().__init__()
        a, b, c, d = stages
        self.stem = convolution(1, 16, 2, 5)  # 64
        self.at32 = nn.Sequential(convolution(16, a, 2), convolution(a, a))
        self.at16 = nn.Sequential(convolution(a, b, 2), convolution(b, b), Deeper(b))
        self.at8 = nn.Sequential(convolution(b, c, 2), convolution(c, c), Deeper(c))
        self.at4 = nn.Sequential(convolution(c, d, 2), convolution(d, d), Deeper(d), Deeper(d))
        self.up8, self.mix8, self.more8 = nn.Conv2d(d, c, 1), convolution(c, c), Deeper(c)
        self.up16, self.mix16, self.more16 = nn.Conv2d(c, b, 1), convolution(b, b), Deeper(b)
        self.up32, self.skip32, self.mix32 = (
            nn.Conv2d(b, fine, 1),
            nn.Conv2d(a, fine, 1),
            convolution(fine, fine),
        )
        self.maps = nn.Conv2d(fine, 2 * COUNT, 1)
        self.answers = nn.Linear(d, 2)

    def forward(self, crop):
        x32 = self.at32(self.stem(crop))
        x16 = self.at16(x32)
        x8 = self.at8(x16)
        x4 = self.at4(x8)

        def double(x):
            return nn.functional.interpolate(x, scale_factor=2, mode="nearest")

        y8 = self.more8(self.mix8(x8 + double(self.up8(x4))))
        y16 = self.more16(self.mix16(x16 + double(self.up16(y8))))
        y32 = self.mix32(self.skip32(x32) + double(self.up32(y16)))
        return self.maps(y32), self.answers(nn.functional.avg_pool2d(x4, 4).flatten(1))


def decode(maps):
    """Joints in crop coordinates [n, COUNT, 3], and the heat [n, COUNT, 32 * 32] that they are means over."""
    heat, depth = maps.flatten(2).split(COUNT, 1)
    heat = heat.softmax(-1)
    place = (torch.arange(MAP, device=maps.device) + 0.5) / (MAP / 2) - 1
    x = (heat.unflatten(-1, (MAP, MAP)).sum(-2) * place).sum(-1)
    y = (heat.unflatten(-1, (MAP, MAP)).sum(-1) * place).sum(-1)
    z = (heat * depth).sum(-1)
    return torch.stack([x, y, z], -1), heat
