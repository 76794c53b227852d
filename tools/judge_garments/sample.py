#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws sewing patterns with GarmentCode's own generator, each for a body of its own measures: a judging set
that vfit has not made. Needs a checkout of GarmentCode (MIT) and its Python packages (numpy below 2, scipy,
svgwrite, svgpathtools, pyyaml, matplotlib, CairoSVG). A seed gives the same designs, but the generator writes
their edges in another order each time. Then: python3 tools/judge_garments OUT.
"""

import argparse
import pathlib
import random
import sys
import types

UP = (
    "armscye_depth bust_line crotch_hip_diff head_l height hips_line vert_bust_line waist_line "
    "waist_over_bust_line arm_length"
).split()
AROUND = {
    "bust": "bust back_width underbust".split(),
    "waist": "waist waist_back_width".split(),
    "hips": "hips hip_back_width".split(),
}
BODIES = ("mean_all", "mean_female", "mean_male")
TRIES = 100  # of a design that the generator's own filters refuse


def vary(body):
    """Another stature and other girths; angles stay."""
    tall, wide = random.uniform(0.93, 1.07), random.uniform(0.9, 1.2)
    own = {name: wide * random.uniform(0.97, 1.04) for name in AROUND}
    for key, value in list(body.params.items()):
        if key.startswith("_") or "incl" in key or "angle" in key or isinstance(value, str):
            continue
        around = [own[name] for name, keys in AROUND.items() if key in keys]
        body.params[key] = value * (tall if key in UP else around[0] if around else 0.5 * (tall + wide))
    body.eval_dependencies()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("garmentcode", type=pathlib.Path, help="folder of the checkout")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2)
    arguments = parser.parse_args()
    sys.path.insert(0, str(arguments.garmentcode))
    sys.modules.setdefault("igl", types.ModuleType("igl"))  # of its simulation, which is not used
    import pattern_sampler
    import pygarment
    from assets.bodies.body_params import BodyParameters
    from assets.garment_programs.meta_garment import MetaGarment

    assets = arguments.garmentcode / "assets"
    random.seed(arguments.seed)
    sampler = pygarment.DesignSampler(str(assets / "design_params" / "default.yaml"))
    arguments.out.mkdir(parents=True, exist_ok=True)
    for number in range(arguments.count):
        body = BodyParameters(str(assets / "bodies" / f"{BODIES[number % len(BODIES)]}.yaml"))
        if number % 2:
            vary(body)
        for _ in range(TRIES):
            design = sampler.randomize()
            try:
                pattern_sampler.assert_param_combinations(design)
                piece = MetaGarment(f"gc{arguments.seed}_{number:03d}", body, design)
                if piece.is_self_intersecting():
                    continue
                pattern = piece.assembly()
            except KeyboardInterrupt:
                raise
            except BaseException:  # the generator's own errors are no Exceptions
                continue
            options = {"to_subfolder": True, "with_3d": False, "with_text": False, "view_ids": False}
            body.save(pathlib.Path(pattern.serialize(arguments.out, tag="", **options)))
            break


if __name__ == "__main__":
    main()
