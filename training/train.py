#!/usr/bin/env python3
"""Trains the skeleton network on virtual people. Stops and goes on at any time: the state lies in --run.

Loss: L1 of the joints in crop coordinates, plus a little cross-entropy of the heat maps to a Gaussian, plus
the facing. The weights that are kept are a running average. Recipe and figures: README.md.
"""

import argparse
import csv
import math
import time
from pathlib import Path

import torch
from torch import nn

import crops
from network import COUNT, CROP, JOINTS, MAP, MIRROR, Network, decode
from unfold import from_onnx

METRE = 1.15  # of one crop unit
HEAT_SIGMA = 0.06


def joint_weights():
    weight = torch.ones(COUNT)
    for i, name in enumerate(JOINTS):
        if "ELBOW" in name:
            weight[i] = 2.0
        if "HAND" in name or "WRIST" in name:
            weight[i] = 2.5
        if "FOOT" in name or "TOES" in name:
            weight[i] = 1.5
    return weight


@torch.no_grad()
def as_labelled(found, batch):
    """The batch with left and right of side views exchanged where `found` has them so.

    A person who turns around changes from one labelling to the other somewhere on the way. With the change
    set at 90 degrees, where no picture tells 89 from 91, the network would answer the mean of both: both
    shoulders in the spine.
    """
    crop, joints, inside, away, person, side = batch

    def error(wanted, weight):
        return ((found - wanted).abs().sum(-1) * weight).sum(-1)

    other, other_inside = joints[:, MIRROR], inside[:, MIRROR]
    turn = side & (error(other, other_inside) < error(joints, inside))
    return (
        crop,
        torch.where(turn[:, None, None], other, joints),
        torch.where(turn[:, None], other_inside, inside),
        torch.where(turn, 1 - away, away),
        person,
        side,
    )


def loss_of(network, batch, weight):
    maps, answers = network(batch[0])
    found, _ = decode(maps)
    crop, joints, inside, away, person, side = as_labelled(found, batch)
    each = (found - joints).abs().sum(-1) * inside * weight
    place = (torch.arange(MAP, device=maps.device) + 0.5) / (MAP / 2) - 1
    # A Gaussian about the joint; its cross-entropy with the heat comes from the logits, not from log(heat).
    across = torch.exp(-((place - joints[..., 0, None]) ** 2) / (2 * HEAT_SIGMA**2))
    along = torch.exp(-((place - joints[..., 1, None]) ** 2) / (2 * HEAT_SIGMA**2))
    wanted = (along[..., :, None] * across[..., None, :]).flatten(2)
    wanted = wanted / wanted.sum(-1, keepdim=True).clamp_min(1e-3)
    logits = maps[:, :COUNT].flatten(2)
    cross = (wanted.sum(-1) * logits.logsumexp(-1) - (wanted * logits).sum(-1)) * inside * weight
    total = each.mean() + 0.02 * cross.mean()
    bce = nn.functional.binary_cross_entropy_with_logits
    return total + 0.02 * (bce(answers[:, 0], away, weight=person) + bce(answers[:, 1], person))


@torch.no_grad()
def judge(network, batch):
    """Mean error in metres and fraction within 10 cm of the joints in view (a crop unit is METRE only at the
    person's own depth), fractions of right answers to facing and to person."""
    network.eval()
    found, answers = [], []
    for part in range(0, len(batch[0]), 64):
        maps, logits = network(batch[0][part : part + 64])
        found.append(decode(maps)[0])
        answers.append(logits > 0)
    network.train()
    found, answers = torch.cat(found), torch.cat(answers)
    _, joints, inside, away, person, _ = as_labelled(found, batch)
    error = ((found - joints).norm(dim=-1) * METRE)[inside > 0.9]
    some = person > 0
    return [
        f"{1000 * error.mean():.1f}",
        f"{(error < 0.1).float().mean():.4f}",
        f"{(answers[some, 0] == (away[some] > 0)).float().mean():.4f}",
        f"{(answers[:, 1] == some).float().mean():.4f}",
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--crops", required=True, help="the vfit-crops program")
    parser.add_argument("--body", required=True, help="the baked body binary")
    parser.add_argument("--run", type=Path, required=True, help="folder of state and log")
    parser.add_argument("--steps", type=int, default=20000, help="length of the schedule")
    parser.add_argument(
        "--clock", type=float, help="length of the schedule in minutes of training, in place of --steps"
    )
    parser.add_argument("--minutes", type=float, default=1e9, help="stop after this time; run again to go on")
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--reuse", type=float, default=1.0, help="how often a crop is used on average")
    parser.add_argument("--pool", type=int, default=16384, help="crops that batches are drawn from")
    parser.add_argument("--start", type=Path, help="weights to start from: a state.pt, or an exported .onnx")
    arguments = parser.parse_args()
    torch.set_num_threads(arguments.threads)
    torch.manual_seed(arguments.seed)
    arguments.run.mkdir(parents=True, exist_ok=True)

    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    unseen = crops.tensors(crops.read(arguments.crops, arguments.body, 1000003, 0, 1440))
    network = Network().to(device, memory_format=torch.channels_last)
    average = Network().to(device)
    if arguments.start and arguments.start.suffix == ".onnx":
        network.load_state_dict(from_onnx(arguments.start, unseen[0]).state_dict())
    elif arguments.start:
        network.load_state_dict(torch.load(arguments.start, map_location=device)["average"])
    average.load_state_dict(network.state_dict())
    optimiser = torch.optim.AdamW(network.parameters(), arguments.rate, weight_decay=1e-4)
    step, seconds, state_file = 0, 0.0, arguments.run / "state.pt"  # seconds of training so far
    if state_file.exists():
        state = torch.load(state_file, map_location=device)
        network.load_state_dict(state["network"])
        average.load_state_dict(state["average"])
        optimiser.load_state_dict(state["optimiser"])
        step, seconds = state["step"], state["seconds"]

    def save():
        part = state_file.with_suffix(".part")
        torch.save(
            {
                "network": network.state_dict(),
                "average": average.state_dict(),
                "optimiser": optimiser.state_dict(),
                "step": step,
                "seconds": seconds + time.time() - begin,
            },
            part,
        )
        part.replace(state_file)

    def on_device(batch):
        return (
            batch[0].to(device).contiguous(memory_format=torch.channels_last),
            *(x.to(device) for x in batch[1:]),
        )

    unseen = on_device(unseen)
    stream = crops.Stream(
        arguments.crops,
        arguments.body,
        arguments.seed,
        step * arguments.batch,
        arguments.processes,
        arguments.pool,
        arguments.reuse,
    )
    weight, begin, last, running = joint_weights().to(device), time.time(), time.time(), []
    log = (arguments.run / "curve.csv").open("a", newline="")
    writer = csv.writer(log, lineterminator="\n")
    if step == 0:
        writer.writerow(["step", "minutes", "loss", "mean_mm", "within_10cm", "facing", "person"])
    while time.time() - begin < 60 * arguments.minutes:
        warm, t = min(1.0, (step + 1) / 200), step / arguments.steps
        if arguments.clock:
            t = (seconds + time.time() - begin) / (60 * arguments.clock)
        if t >= 1.0:
            break
        for group in optimiser.param_groups:
            group["lr"] = arguments.rate * warm * (0.5 + 0.5 * math.cos(math.pi * t)) + 1e-6
        batch = on_device(stream.batch(arguments.batch))
        loss = loss_of(network, batch, weight)
        optimiser.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(network.parameters(), 1.0)
        optimiser.step()
        keep = min(0.999, (step + 1) / (step + 10))
        with torch.no_grad():
            for a, b in zip(average.state_dict().values(), network.state_dict().values()):
                a.lerp_(b, 1 - keep) if a.is_floating_point() else a.copy_(b)
        running.append(loss.item())
        step += 1
        if step % 500 == 0:
            writer.writerow(
                [
                    step,
                    f"{(time.time() - begin) / 60:.1f}",
                    f"{sum(running) / len(running):.4f}",
                    *judge(average, unseen),
                ]
            )
            log.flush()
            running = []
        if time.time() - last > 120:
            save()
            last = time.time()
    save()
    stream.close()


if __name__ == "__main__":
    main()
