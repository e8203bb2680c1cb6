# %% [markdown]
# The four-stage element test of the paper (figure 5), once by the driver and once by hand, and its picture. Cells are
# between the lines with %%; as a whole: python3 four_stage.py DATA OUT.png, DATA being the folder data of the sources.

# %%
import json
import pathlib
import sys
import warnings

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy

import fpz

data = pathlib.Path(sys.argv[1])
warnings.simplefilter("ignore", fpz.FpzWarning)  # the zone is the paper's, which starts with preloaded springs

# %% The driver runs the file.
file = data / "paths" / "four_stage.json"
result = fpz.run_path(file)
print(result)

# %% The same with a point of one's own.
path = json.loads(file.read_text())
rock = fpz.Material(
    data / "materials" / "johnstone.json",
    rve_length=path["rve_length"],
    setting=path["setting"],
    cohesive_zone="published",
)
point = fpz.Point(rock)
for stage in path["stages"]:
    step = [stage["strain_increment"].get(c, 0.0) for c in ("xx", "yy", "xy")]
    for _ in range(stage["increments"]):
        point.update(step)
difference = abs(point.stress[0] - result.history["sig_xx"][-1])
print(f"D = {point.damage:.6f}; the driver's last sig_xx differs by {difference:.1e} Pa")

# %% Stress over time, damage, and the traction inside its shrinking surface.
h = result.history
figure, (stress, damage, traction) = pyplot.subplots(1, 3, figsize=(15, 4.2), layout="constrained")
fpz.plot.history(h, "time", "sig_xx", "sig_yy", "sig_xy", axes=stress)
stress.set_ylabel("stress, Pa")
fpz.plot.history(h, "time", "D", axes=damage)
cracked = h[h["cracked"] > 0]
fpz.plot.history(cracked, "t_n", "t_s1", axes=traction, color="k", linewidth=1)
for integrity in (1.0, 1.0 - h["D"][h["time"] <= 1.0][-1], 1.0 - h["D"][-1]):
    fpz.plot.yield_surface(rock, traction, integrity, linewidth=0.8, label=f"D = {1 - integrity:.2f}")
traction.set_xlim(-0.5e6, 0.7e6)
traction.set_ylim(-1.2e6, 1.2e6)
traction.legend()
figure.savefig(sys.argv[2], dpi=90)
