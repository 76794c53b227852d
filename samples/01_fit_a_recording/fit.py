"""Fits a recording or the virtual person: prints measures and size, drapes the sundress. Writes nothing.

python fit.py [RECORDING or sensor URI]
"""

import sys

import numpy as np

import vfit

source = sys.argv[1] if len(sys.argv) > 1 else "virtual:motion=demo&sex=f&frames=60&seed=7"

with vfit.Context() as ctx:
    # Scan: the same tracked frames tell the measures and drive the motion.
    tracker, scan, motion = vfit.Tracker(ctx), vfit.Scan(ctx), vfit.Motion(ctx)
    for frame in ctx.open(source):
        tracked = tracker.update(frame)
        state = scan.add(tracked)
        if motion.step(tracked) and state.complete:
            break
    print(f"{state.frames_taken} of {state.frames_wanted} frames taken, last guidance {state.guidance.name}")
    measures = scan.measure()
    for key, m in measures.items():
        unit = key.rpartition("_")[2]
        print(f"  {key:22} {m.value:.3f} +- {m.sigma:.3f} {unit}{'' if m.observed else '  (inferred)'}")

    # Size: every label with its probability.
    garment = vfit.Garment.open(ctx, "sundress")
    chart = vfit.SizeChart.open(ctx, garment.info.size_chart)
    for label, probability in chart.recommend(garment.info.garment_kind, measures)[:3]:
        print(f"size {label}: {probability:.0%}")

    # Dress: an avatar of that size in the person's pose, a second of cloth.
    avatar = vfit.Avatar.from_scan(scan)
    avatar.pose(motion.pose())
    cloth = vfit.Cloth(avatar, garment)
    for _ in range(60):
        cloth.step(1 / 60)
    dress = cloth.acquire()
    assert np.isfinite(dress.positions).all()
    print(f"dressed: {len(dress.positions)} vertices, largest strain {dress.strain.max():.1%}")
