#!/usr/bin/env python3
"""The weighted mean of exported networks that come from one another by more training.

The mean of such weights is right where either network is, and is less bound to the people and things that the
later one saw last (Wortsman et al. 2022, "Model soups").
"""

import argparse
from pathlib import Path

import numpy as np
import onnx
from onnx import numpy_helper


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("parts", nargs="+", help="FILE:WEIGHT; the weights' sum is taken as one")
    arguments = parser.parse_args()
    files, shares = zip(*(part.rsplit(":", 1) for part in arguments.parts))
    shares = np.array(shares, np.float64) / np.sum(np.array(shares, np.float64))
    models = [onnx.load(file) for file in files]
    values = [{w.name: numpy_helper.to_array(w) for w in model.graph.initializer} for model in models]
    for weight in models[0].graph.initializer:
        own = values[0][weight.name]
        if own.dtype.kind != "f":
            continue
        mean = sum(share * v[weight.name].astype(np.float64) for share, v in zip(shares, values))
        weight.CopyFrom(numpy_helper.from_array(mean.astype(own.dtype), weight.name))
    onnx.save(models[0], str(arguments.out))


if __name__ == "__main__":
    main()
