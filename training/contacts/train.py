#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns the network of foot contacts from rows of `vfit-bench contact-features` and writes it as C++ tables.

    train.py ROWS [ROWS ...] --out sdk/motion/contact_weights.inc [--seed 1]

A tenth of the streams is kept back and printed as held out. Needs NumPy alone."""

import argparse

import numpy as np

FEATURES = 62
HIDDEN = (64, 32)
STEPS, BATCH, RATE = 40000, 2048, 0.004
UP, DOWN = 0.6, 0.4  # of the chance to stand: planted from the first on, free below the second


def read(files):
    parts, first = [], 0
    for name in files:
        rows = np.fromfile(name, np.float32).reshape(-1, FEATURES + 3)
        rows[:, FEATURES + 1] += first
        first = int(rows[:, FEATURES + 1].max()) + 8
        parts.append(rows)
    return np.concatenate(parts)


class Network:
    def __init__(self, rng, mean, deviation):
        self.mean, self.deviation = mean, deviation
        sizes = (FEATURES,) + HIDDEN + (1,)
        # Single precision throughout: tanh is six times as fast.
        self.layers = [
            [(rng.normal(size=(a, b)) / np.sqrt(a)).astype(np.float32), np.zeros(b, np.float32)]
            for a, b in zip(sizes, sizes[1:])
        ]

    def forward(self, x):
        """Activations of every layer; the last one is the logit."""
        out = [np.clip((x - self.mean) / self.deviation, -5, 5)]
        for i, (weight, bias) in enumerate(self.layers):
            z = out[-1] @ weight + bias
            out.append(np.tanh(z) if i + 1 < len(self.layers) else z)
        return out

    def chance(self, x):
        return 1 / (1 + np.exp(-self.forward(x)[-1][:, 0]))


def train(network, x, y, weight, rng):
    """Adam on the cross entropy."""
    flat = [p for layer in network.layers for p in layer]
    first, second = [np.zeros_like(p) for p in flat], [np.zeros_like(p) for p in flat]
    for step in range(1, STEPS + 1):
        pick = rng.integers(0, len(x), BATCH)
        acts = network.forward(x[pick])
        chance = 1 / (1 + np.exp(-acts[-1][:, 0]))
        grad = ((chance - y[pick]) * weight[pick] / BATCH)[:, None]
        grads = []
        for i in reversed(range(len(network.layers))):
            w, _ = network.layers[i]
            grads[:0] = [acts[i].T @ grad + 1e-5 * w, grad.sum(0)]
            grad = (grad @ w.T) * (1 - acts[i] ** 2) if i else None
        rate = RATE * min(1.0, 2.0 * (1 - step / STEPS) + 0.02)
        for k, g in enumerate(grads):
            first[k] = 0.9 * first[k] + 0.1 * g
            second[k] = 0.999 * second[k] + 0.001 * g * g
            flat[k] -= rate * (first[k] / (1 - 0.9**step)) / (np.sqrt(second[k] / (1 - 0.999**step)) + 1e-8)


def decide(chance):
    planted, state = np.zeros(len(chance), bool), chance[0] > 0.5
    for i, c in enumerate(chance):
        state = c > (DOWN if state else UP)
        planted[i] = state
    return planted


def near(flags):
    out = flags.copy()
    out[1:] |= flags[:-1]
    out[:-1] |= flags[1:]
    return out


def f1(streams):
    """Of a class of (truth, said) flags a stream, within one frame."""
    said = sum(s.sum() for _, s in streams)
    right = sum((s & near(t)).sum() for t, s in streams)
    true = sum(t.sum() for t, _ in streams)
    found = sum((t & near(s)).sum() for t, s in streams)
    p, r = right / max(said, 1), found / max(true, 1)
    return p, r, 2 * p * r / max(p + r, 1e-9)


def judge(name, network, rows):
    streams = []
    for stream in np.unique(rows[:, FEATURES + 1]):
        part = rows[rows[:, FEATURES + 1] == stream]
        streams.append((part[:, FEATURES] > 0.5, decide(network.chance(part[:, :FEATURES]))))
    lifted, planted = f1([(~t, ~s) for t, s in streams]), f1(streams)
    print(
        f"{name}: lifted P {lifted[0]:.3f} R {lifted[1]:.3f} F1 {lifted[2]:.3f}, "
        f"planted F1 {planted[2]:.3f}, {len(streams)} feet",
        flush=True,
    )


def write(network, file):
    def table(name, values):
        numbers = [f"{v:.5g}" for v in np.asarray(values).ravel()]
        numbers = [n if "." in n or "e" in n else n + ".0" for n in numbers]
        lines, line = [], ""
        for n in numbers:
            if len(line) + len(n) > 112:
                lines.append(line)
                line = ""
            line += n + "f, "
        return f"constexpr float {name}[] = {{\n" + "\n".join(l.rstrip() for l in lines + [line]) + "\n};\n"

    with open(file, "w") as out:
        out.write("// Made by training/contacts/train.py. Weights stand by unit, its inputs side by side.\n")
        out.write(f"constexpr int kHidden1 = {HIDDEN[0]}, kHidden2 = {HIDDEN[1]};\n")
        out.write(table("kMean", network.mean) + table("kScale", 1 / network.deviation))
        for i, (weight, bias) in enumerate(network.layers):
            out.write(table(f"kWeights{i + 1}", weight.T) + table(f"kBias{i + 1}", bias))


def main():
    arguments = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    arguments.add_argument("rows", nargs="+")
    arguments.add_argument("--out", required=True)
    arguments.add_argument("--seed", type=int, default=1)
    options = arguments.parse_args()
    rng = np.random.default_rng(options.seed)
    rows = read(options.rows)
    # Streams come in eights: two feet of four versions of one person.
    person = (rows[:, FEATURES + 1] // 8).astype(int)
    held = person % 10 == 0
    learnt = rows[~held]
    mean, deviation = learnt[:, :FEATURES].mean(0), learnt[:, :FEATURES].std(0) + 1e-3
    network = Network(rng, mean, deviation)
    # A lifted foot is the rarer one.
    weight = np.where(learnt[:, FEATURES] > 0.5, 1.0, 1.5).astype(np.float32)
    train(network, learnt[:, :FEATURES], learnt[:, FEATURES], weight, rng)
    judge("learnt from", network, learnt)
    judge("held out", network, rows[held])
    version = (rows[:, FEATURES + 1] // 2 % 4).astype(int)
    for v, name in enumerate(
        ("tracked", "tracked, no toes", "truth with noise", "truth with noise and jumps")
    ):
        judge("held out, " + name, network, rows[held & (version == v)])
    write(network, options.out)


if __name__ == "__main__":
    main()
