#!/usr/bin/env python3
"""Designs of a cohesive zone side by side: the table of docs/method-law.md and the picture of docs/equations.md.

    scripts/cohesive_zones.py            prints the table
    scripts/cohesive_zones.py --picture  writes docs/images/cohesive-zones.svg as well (needs gnuplot)

A zone of the marble of data/materials at a constant normal traction: yield surface, softening and flow are those of the
paper (eq 47-50), and w = exp(-kappa/delta0) is stepped; the designs differ in the elastic jump, in the energy that they
store and in the reversible part of the plastic jump. It shares no code with the library.
"""
import json
import math
import os
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
with open(os.path.join(ROOT, "data/materials/marble.json"), encoding="utf-8") as file:
    MARBLE = json.load(file)
SIGMA, COHESION, DELTA = (MARBLE[k] for k in ("tensile_strength", "cohesion", "delta0"))
TAN_PHI, TAN_PSI = (math.tan(math.radians(MARBLE[k])) for k in ("friction_angle_deg", "dilation_angle_deg"))
APEX = COHESION - SIGMA * TAN_PHI
ENERGY = SIGMA * DELTA


class Design:
    """Compliance C(w) of the elastic jump per component, with 'offset' counted from onset, and the share of the
    compliance's growth that is reversible work."""

    def __init__(self, name, compliance, stiffness, preloaded=False, reversible=0.0):
        self.name, self.compliance, self.preloaded, self.reversible = name, compliance, preloaded, reversible
        self.flexibility = tuple(1.0 / k for k in stiffness)

    def c(self, w, t):
        """Normal and shear compliance. The published normal spring does not soften under pressure."""
        normal = 1.0 if self.preloaded and t[0] < 0.0 else self.compliance(w)
        return normal * self.flexibility[0], self.compliance(w) * self.flexibility[1]

    def jump(self, w, t, onset):
        rest = [f * x for f, x in zip(self.flexibility, onset)] if self.preloaded else (0.0, 0.0)
        return [c * x - r for c, x, r in zip(self.c(w, t), t, rest)]

    def stored(self, w, t, onset):
        start = sum(0.5 * f * x * x for f, x in zip(self.flexibility, onset)) if self.preloaded else 0.0
        return sum(0.5 * c * x * x for c, x in zip(self.c(w, t), t)) - start


def on_surface(w, normal):
    """Shear traction of eq 48 at a normal traction."""
    return math.sqrt(max((w * COHESION - normal * TAN_PHI) ** 2 - (w * APEX) ** 2, 0.0))


def traction(w, normal):
    return (SIGMA * w, 0.0) if normal is None else (normal, on_surface(w, normal))


def slide(design, normal, end, steps=20000):
    """From onset to w = end at a constant normal traction (None: pure opening). Work, least stored, states."""
    onset = last = traction(1.0, normal)
    jump = design.jump(1.0, onset, onset)
    plastic = [0.0, 0.0]
    w, work, least, states = 1.0, 0.0, 0.0, [(0.0, onset[1])]
    for k in range(1, steps + 1):
        new = 1.0 + (end - 1.0) * k / steps if end > 0.5 else end ** (k / steps)
        t = traction(new, normal)
        kappa = DELTA * math.log(w / new)
        flow = TAN_PSI * (0.5 * (w + new) * COHESION - 0.5 * (last[0] + t[0]) * TAN_PSI)
        slip = 0.5 * (last[1] + t[1])
        for i, part in enumerate((flow, slip)):
            share = part / (flow + slip) * kappa
            back = design.reversible * design.flexibility[i] * 0.5 * (last[i] + t[i]) * (w - new)
            plastic[i] += share - back
        now = [p + e for p, e in zip(plastic, design.jump(new, t, onset))]
        work += sum(0.5 * (a + b) * (y - x) for a, b, x, y in zip(last, t, jump, now))
        least = min(least, design.stored(new, t, onset))
        w, last, jump = new, t, now
        states.append((jump[1], t[1]))
    return work, least, last, states


def designs():
    paper = (MARBLE["normal_stiffness"], MARBLE["shear_stiffness"])
    used = (max(paper[0], SIGMA / DELTA), max(paper[1], COHESION / DELTA))
    return [
        Design("published", lambda w: 1.0 / w, paper, preloaded=True),
        Design("published, Ks = 1e13", lambda w: 1.0 / w, (paper[0], 1e13), preloaded=True),
        Design("D/((1 - D) K)", lambda w: (1.0 - w) / w, paper),
        Design("D/K, all of it dissipated", lambda w: 1.0 - w, paper),
        Design("D/K, half of the growth reversible, K raised: chosen", lambda w: 1.0 - w, used, reversible=0.5),
    ]


def soft(design, k):
    """The same design with both stiffnesses k."""
    raised = "raised" in design.name
    pair = (max(k, SIGMA / DELTA), max(k, COHESION / DELTA)) if raised else (k, k)
    return Design(design.name, design.compliance, pair, design.preloaded, design.reversible)


def table():
    print("| design | error of G_I | K = 1e12 | net work, J/m2 | least stored, J/m2 | elastic slip, um |")
    print("| --- | --- | --- | --- | --- | --- |")
    for d in designs():
        opening = slide(d, None, 1e-9)[0] / ENERGY - 1.0
        opening_soft = slide(soft(d, 1e12), None, 1e-9)[0] / ENERGY - 1.0
        work, least, last, _ = slide(d, -20e6, 0.98)
        onset = traction(1.0, -20e6)
        net = work - (d.stored(0.98, last, onset) - d.stored(0.98, (0.0, 0.0), onset))
        least = min(least, d.stored(0.98, (0.0, 0.0), onset), slide(d, -20e6, 1e-3)[1])
        end = slide(d, -20e6, 1e-3)[2]
        slip = d.c(1e-3, end)[1] * end[1]
        print(f"| {d.name} | {opening:.1e} | {opening_soft:.1e} | {net:.1f} | {least:.1f} | {slip * 1e6:.1f} |")


def loop(design, normal=-20e6, turn=0.5):
    """Onset, sliding until w = turn, elastic unloading to the opposite side: (u_s in um, t_s in MPa)."""
    onset = traction(1.0, normal)
    states = slide(design, normal, turn, 2000)[3]
    top = states[-1]
    back = -on_surface(turn, normal)
    compliance = design.c(turn, (normal, 0.0))[1]
    states.append((top[0] + compliance * (back - top[1]), back))
    return [(0.0, 0.0), (0.0, onset[1])] + states


def picture():
    chosen = designs()
    script = ['set terminal svg size 800,360 font "sans,12"', "set output 'docs/images/cohesive-zones.svg'",
              "set multiplot layout 1,2", "set xlabel 'shear jump (um)'", "set ylabel 'shear traction (MPa)'",
              "set grid", "set xzeroaxis", "unset key"]
    for name, design in (("published", chosen[0]), ("consistent", chosen[-1])):
        states = loop(design)
        script += [f"set title '{name}'", "plot '-' with lines lw 2"]
        script += [f"{u * 1e6:.5g} {t / 1e6:.5g}" for u, t in states[::20] + states[-1:]] + ["e"]
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True, cwd=ROOT)


if __name__ == "__main__":
    table()
    if "--picture" in sys.argv:
        picture()
