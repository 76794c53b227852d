#!/usr/bin/env python3
"""Writes the averaged weights of a training run as ONNX, with batch norms folded into the convolutions."""

import argparse
from pathlib import Path

import torch
from torch.nn.utils.fusion import fuse_conv_bn_eval

from network import CROP, Network


def fold(module):
    for child in module.children():
        fold(child)
    if (
        isinstance(module, torch.nn.Sequential)
        and len(module) > 1
        and isinstance(module[1], torch.nn.BatchNorm2d)
    ):
        module[0] = fuse_conv_bn_eval(module[0], module[1])
        module[1] = torch.nn.Identity()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("state", type=Path)
    parser.add_argument("out", type=Path)
    arguments = parser.parse_args()
    network = Network()
    network.load_state_dict(torch.load(arguments.state)["average"])
    network.eval()
    fold(network)
    torch.onnx.export(
        network,
        (torch.zeros(1, 1, CROP, CROP),),
        str(arguments.out),
        input_names=["crop"],
        output_names=["maps", "answers"],
        opset_version=11,
        dynamo=False,
    )


if __name__ == "__main__":
    main()
