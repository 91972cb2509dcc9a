#!/usr/bin/env python3
"""Run a scene and check what a user would have noticed. Numpy where tips are looked at.

    check_scene.py --program build/source/stockwork --scratch DIR --deck DECK ...

    --beside DECK --within COLUMN=SHARE   COLUMN of statistics.csv, averaged over the last half of the time
                                          that both runs have reached, is that of the other deck;
                                          COLUMN=SHARE,FACTOR: this many times that
    --every 'COLUMN OP VALUE'             in every row, the last ones of a run that failed as well
    --tips ANGLE,DEGREES                  the last eight cells (of --cell) at both ends of the fracture
                                          point to ANGLE
    --kink TABLE,NOTCH,XX,YY,DEGREES      the chord of each wing of a notch through the origin, from its end to the
                                          tip, turns from its direction, NOTCH degrees, by as much as linear
                                          fracture mechanics says for this length and the net stress XX, YY, within
                                          DEGREES; the first kink of that path is the one of the TABLE
    --symmetric X,Y,LENGTH                each end of the fracture's pieces has its image in (X, Y) no further
                                          than LENGTH [m] from the fracture
    --mirror Y,LENGTH                     the same of their images in the line y = Y
    --peak COLUMN=VALUE,SHARE             of the fracture's last file: the greatest of its absolute values
    --least COLUMN=SHARE                  of the fracture's last file: not below minus SHARE of its greatest
    --ends STATUS [--says TEXT]           the run ends with one of these statuses, and says why
    --checked                             --check finds it: status 1, or a warning with status 0 if --ends 0
"""
import math
import os
import sys

from judged import HERE, judge, parser_of
from run_case import OPERATORS
from results import read_statistics


def late_mean(times, values, end):
    """The average over [end/2, end] of what is linear between the steps."""
    total, begin = 0., 0.5 * end
    for t0, t1, a, b in zip(times, times[1:], values, values[1:]):
        low, high = max(t0, begin), min(t1, end)
        if high > low:
            def at(t):
                return a + (b - a) * (t - t0) / (t1 - t0)
            total += 0.5 * (at(low) + at(high)) * (high - low)
    return total / (end - begin)


def check_beside(runner, options):
    one, two = (read_statistics(runner.output(name)) for name in ("run", "beside"))
    end = min(one["time"][-1], two["time"][-1])
    failed = []
    for text in options.within:
        column, bound, *factor = text.replace("=", ",").split(",")
        found, wanted = (late_mean(t["time"], t[column], end) for t in (one, two))
        wanted *= float(factor[0]) if factor else 1.
        off = found / wanted - 1
        print(f"  {column}: {found:.5g} beside {wanted:.5g}, {100 * off:+.2f} %")
        if not abs(off) <= float(bound):
            failed.append(f"{column} is {100 * off:+.2f} % off the run beside it up to {end:g} s")
    return failed


def check_rows(table, texts):
    failed = []
    for text in texts:
        column, sign, value = text.split()
        wrong = [(t, x) for t, x in zip(table["time"], table[column])
                 if not (isinstance(x, float) and OPERATORS[sign](x, float(value)))]
        print(f"  {text}: {len(wrong)} of {len(table['time'])} rows break it")
        if wrong:
            failed.append(f"{text}: {column} is {wrong[0][1]} at {wrong[0][0]:g} s")
    return failed


def last_fracture(directory):
    import vtu
    fracture = vtu.read(vtu.at_time(vtu.series(directory, "fracture"))[1])
    ends, cells = fracture.cells(vtu.LINE)
    return fracture, ends, cells


def last_values(directory, name):
    fracture, ends, cells = last_fracture(directory)
    return fracture.cell_data[name][cells] if name in fracture.cell_data else fracture.point_data[name][ends]


def check_peak(directory, texts):
    failed = []
    for text in texts:
        name, wanted = text.split("=")
        wanted, share = (float(x) for x in wanted.split(","))
        peak = abs(last_values(directory, name)).max()
        print(f"  {name}: {peak:.5g} at most, {100 * (peak / wanted - 1):+.2f} % off {wanted:g}")
        if not abs(peak / wanted - 1) <= share:
            failed.append(f"the greatest {name} is {peak:g}, not {wanted:g}")
    return failed


def check_least(directory, texts):
    failed = []
    for text in texts:
        name, share = text.split("=")
        values = last_values(directory, name)
        print(f"  {name}: from {values.min():.4g} to {values.max():.4g}")
        if not values.min() >= -float(share) * values.max():
            failed.append(f"{name} goes down to {values.min():.4g} where the greatest is {values.max():.4g}")
    return failed


def check_tips(directory, angle, bound, cell):
    import numpy as np
    fracture, ends, _ = last_fracture(directory)
    points = fracture.points[ends][:, :, :2].reshape(-1, 2)
    t = direction(angle)
    failed = []
    for sign in (-1, 1):
        tip = points[np.argmax(sign * (points @ t))]
        near = points[np.linalg.norm(points - tip, axis=1) < 8 * cell]
        chord = tip - near[np.argmax(np.linalg.norm(near - tip, axis=1))]
        off = math.degrees(math.atan2(chord[1], chord[0])) - angle
        off = (off + 90.) % 180. - 90.
        print(f"  tip at {tip}: {off:+.1f} degrees off")
        if not abs(off) <= bound:
            failed.append(f"the tip at {tip} is {off:+.1f} degrees off")
    return failed


def direction(degrees):
    import numpy as np
    return np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])


def kink_of(table, notch):
    with open(os.path.join(HERE, "..", "data", "reference", table), encoding="utf-8") as file:
        lines = [line.strip().split(",") for line in file if not line.startswith("#")]
    column = lines[0].index("kink_max_hoop_deg")
    return next(float(row[column]) for row in lines[1:] if float(row[0]) == notch)


def check_kink(directory, table, notch, xx, yy, bound):
    import numpy as np
    from kinked_path import turns
    fracture, ends, _ = last_fracture(directory)
    points = fracture.points[ends][:, :, :2].reshape(-1, 2)
    t = direction(notch)
    off_line = np.abs(points @ np.array([-t[1], t[0]])) / np.abs(points).max()
    failed = []
    for sign in (-1, 1):
        on_line = points[off_line < 1e-4]  # crossings are kept off vertices
        old = on_line[np.argmax(sign * (on_line @ t))]
        tip = points[np.argmax(sign * (points @ t))]
        chord = sign * (tip - old)
        length = np.linalg.norm(chord)
        if not length > 0:
            failed.append(f"the wing that ends at {old} has not grown")
            continue
        turn = (math.degrees(math.atan2(chord[1], chord[0])) - notch + 180.) % 360. - 180.
        first, wanted = turns(np.linalg.norm(old), notch, np.array([xx, yy]), length)
        print(f"  from {old} to {tip}: turned by {turn:.2f} degrees, expected {wanted:.2f}")
        if not abs(turn - wanted) <= bound:
            failed.append(f"the wing that ends at {tip} turns by {turn:.2f} degrees, not {wanted:.2f}")
        if not abs(first - kink_of(table, notch)) <= 0.02:
            failed.append(f"the path that is compared with begins with {first:.2f} degrees, not {kink_of(table, notch):.2f}")
    return failed


def check_symmetric(directory, x, y, bound):
    import numpy as np
    return check_images(directory, lambda points: 2 * np.array([x, y]) - points, bound)


def check_mirror(directory, y, bound):
    return check_images(directory, lambda points: points * [1, -1] + [0, 2 * y], bound)


def check_images(directory, image_of, bound):
    import numpy as np
    starts, stops = last_pieces(directory)
    along = stops - starts
    worst = 0.
    for image in image_of(np.concatenate([starts, stops])):
        at = np.clip(((image - starts) * along).sum(1) / (along * along).sum(1), 0., 1.)
        worst = max(worst, np.linalg.norm(starts + at[:, None] * along - image, axis=1).min())
    print(f"  images lie {worst:.4g} m from the fracture at most")
    return [] if worst <= bound else [f"the image of a piece lies {worst:g} m from the fracture"]


def last_pieces(directory):
    fracture, ends, _ = last_fracture(directory)
    points = fracture.points[ends][:, :, :2]
    return points[:, 0], points[:, 1]


def run(runner, options):
    if options.checked:
        command = runner.command("check", options.deck, options.set, extra=["--check"])
        status = runner.wait(runner.start("check", command), command)
        said = " ".join((runner.text("check", "stdout") + runner.text("check", "stderr")).split())
        return judge_end(runner, "check", status, said, options)
    command = runner.command("run", options.deck, options.set)
    status = runner.wait(runner.start("run", command), command)
    said = " ".join((runner.text("run", "stdout") + runner.text("run", "stderr")).split())
    failed = judge_end(runner, "run", status, said, options)
    if options.every:
        failed += check_rows(read_statistics(runner.output("run")), options.every)
    if failed:
        return failed
    if options.beside:
        runner.run("beside", options.beside, options.beside_set)
        failed += check_beside(runner, options)
    failed += check_least(runner.output("run"), options.least)
    failed += check_peak(runner.output("run"), options.peak)
    if options.kink:
        table, *numbers = options.kink.split(",")
        failed += check_kink(runner.output("run"), table, *(float(x) for x in numbers))
    if options.symmetric:
        failed += check_symmetric(runner.output("run"), *(float(x) for x in options.symmetric.split(",")))
    if options.mirror:
        failed += check_mirror(runner.output("run"), *(float(x) for x in options.mirror.split(",")))
    if options.tips:
        angle, bound = (float(x) for x in options.tips.split(","))
        failed += check_tips(runner.output("run"), angle, bound, options.cell)
    return failed


def judge_end(runner, name, status, said, options):
    failed = []
    if str(status) not in options.ends.split("|"):
        failed.append(f"exit status {status}, should be {options.ends}\n{runner.tail(name)}")
    failed += [f"it does not say '{text}'\n{runner.tail(name)}" for text in options.says if text not in said]
    return failed


def main():
    parser = parser_of(__doc__, 600., "beside-set", "within", "every", "least", "peak", "says")
    for name in ("beside", "kink", "symmetric", "mirror", "tips"):
        parser.add_argument(f"--{name}")
    parser.add_argument("--cell", type=float, default=1.)
    parser.add_argument("--ends", default="0")
    parser.add_argument("--checked", action="store_true")
    return judge(run, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
