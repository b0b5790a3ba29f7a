#!/usr/bin/env python3
"""Runs the benchmarks and writes bench/results.md: Tourmaline beside GetFEM on the paper's conductive case and on the
twisted block, the floors of a step and of the factorisation, growth with the mesh. Everything runs in turn, on one thread
and one core.

    bench/run.py [--quick]      --quick: no n = 256 for the peer, no n = 512, no 2,000 steps, small blocks
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"
PROGRAM = BUILD / "apps" / "tourmaline" / "tourmaline"
CASE = ROOT / "cases" / "ouafik-2020" / "conductive.toml"
BLOCK = ROOT / "cases" / "block-3d" / "twisted.toml"
PEER = ROOT / "bench" / "peers" / "getfem_paper.py"
BLOCK_PEER = ROOT / "bench" / "peers" / "getfem_block.py"

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", OMP_WAIT_POLICY="passive",
                   OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
ENVIRONMENT.pop("OPENBLAS_CORETYPE", None)  # both programs get the kernels that they choose


def on_one_core(command, core=0):
    """Runs a command; its wall-clock seconds from start to end."""
    begin = time.perf_counter()
    done = subprocess.run(["taskset", "-c", str(core), *map(str, command)], env=ENVIRONMENT, capture_output=True, text=True)
    seconds = time.perf_counter() - begin
    if done.returncode:
        sys.exit(f"bench: {' '.join(map(str, command))} failed:\n{done.stderr}")
    return seconds, done.stdout


def tourmaline(n, steps, folder, *overrides):
    return run_case(CASE, folder, f"mesh.box.cells=[{n},{n}]", f"time.steps={steps}", *overrides)


def run_case(case, folder, *overrides, ranks=1, core=0):
    arguments = [PROGRAM, "run", case, "-o", folder, "--set", "output.fields=false", "--set", "output.report=false"]
    for override in overrides:
        arguments += ["--set", override]
    seconds, _ = on_one_core(arguments, core) if ranks == 1 else on_cores(arguments, ranks)
    summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
    with open(pathlib.Path(folder) / "history.csv") as table:
        newton = [int(row["newton_iterations"]) for row in csv.DictReader(table)]
    return {"wall": seconds, "summary": summary, "newton": newton}


def on_cores(command, ranks):
    begin = time.perf_counter()
    done = subprocess.run(["mpirun", "-np", str(ranks), *map(str, command)], env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"bench: {' '.join(map(str, command))} failed on {ranks} ranks:\n{done.stderr}")
    return time.perf_counter() - begin, done.stdout


def median_of(count, run):
    """The run with the median wall-clock time."""
    return sorted((run() for _ in range(count)), key=lambda r: r["wall"])[count // 2]


def peer(n, steps, run_steps, folder, *options):
    return measured_peer(PEER, n, steps, folder, "--run-steps", run_steps, *options)


def measured_peer(program, n, steps, folder, *options):
    out = pathlib.Path(folder) / "peer.json"
    seconds, _ = on_one_core(["/usr/bin/python3", program, "--cells", n, "--steps", steps, "--json", out,
                              "--nodes", pathlib.Path(folder) / "peer.csv", *options])
    result = json.loads(out.read_text())
    result["wall"] = seconds
    return result


def largest_difference(ours, theirs):
    """Over all columns of two nodes.csv: the largest difference over the column's largest size."""
    with open(ours) as a, open(theirs) as b:
        left, right = list(csv.DictReader(a)), list(csv.DictReader(b))
    assert len(left) == len(right)
    worst = 0
    for column in (name for name in ("u_x", "u_y", "u_z", "potential", "temperature") if name in right[0]):
        assert all(math.isfinite(float(row[column])) for row in left + right)
        size = max(abs(float(row[column])) for row in right)
        worst = max(worst, max(abs(float(p[column]) - float(q[column])) for p, q in zip(left, right)) / size)
    return worst


def agreed(ours, theirs, limit, n):
    """The largest difference, if it is small enough; otherwise the bench ends here."""
    difference = largest_difference(pathlib.Path(ours) / "nodes.csv", pathlib.Path(theirs) / "peer.csv")
    if difference > limit:
        sys.exit(f"bench: the answers differ by {difference:.2g} at n = {n}")
    return difference


def steps_only(run):
    return run["summary"]["seconds"]["step"]["total"] + run["summary"]["seconds"]["output"]


def set_up(seconds):
    return sum(seconds[stage] for stage in ("mesh", "assemble", "analyse", "factorise", "condense"))


def mebibytes(value):
    return f"{value / 2**20:.0f}"


def compare(folder, quick):
    rows = []
    for n, steps, run_steps in ((32, 20, 20), (64, 20, 20), (128, 20, 20), (64, 200, 20)):
        print(f"peer: n = {n}, {steps} steps", flush=True)
        ours = median_of(3, lambda: tourmaline(n, steps, folder))
        theirs = peer(n, steps, run_steps, folder)
        if steps == 20 and n > 32:
            rows.append((n, steps, run_steps, ours,
                         peer(n, steps, run_steps, folder, "--prediction", "paper", "--solver", "auto"), None,
                         ", paper's start"))
        if run_steps == steps:
            difference = agreed(folder, folder, 1e-6, n)
        rows.append((n, steps, run_steps, ours, theirs, difference if run_steps == steps else None, ""))
    if not quick:
        ours, theirs = tourmaline(256, 20, folder), peer(256, 20, 2, folder)
        rows.append((256, 20, 2, ours, theirs, None, ""))
    return rows


def comparison_table(rows, startup, member):
    lines = ["| n | steps | Tourmaline, s | GetFEM, s | whole process | without start-up | per step | Newton, T / G |"
             " peak MiB, T / G | largest difference |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for n, steps, run_steps, ours, theirs, difference, form in rows:
        peer_step = theirs["seconds"]["steps"] / run_steps
        peer_wall = theirs["wall"] + peer_step * (steps - run_steps)
        own_step = steps_only(ours) / steps
        mark = "" if run_steps == steps else f" ({run_steps} steps run)"
        own_net = set_up(ours["summary"]["seconds"]) + steps_only(ours)
        peer_net = theirs["seconds"]["assemble"] + peer_step * steps
        lines.append(
            f"| {n}{form} | {steps} | {ours['wall']:.2f} | {peer_wall:.1f}{mark} | {peer_wall / ours['wall']:.0f} | "
            f"{peer_net / own_net:.0f} | {peer_step / own_step:.0f} | "
            f"{sum(ours['newton'])} / {sum(theirs['newton_iterations'])} | "
            f"{mebibytes(ours['summary']['memory'])} / {mebibytes(theirs['peak_rss_bytes'])} | "
            f"{'' if difference is None else format(difference, '.1e')} |")
    lines.append("")
    lines.append(f"Start-up: a case of 2 x 2 squares and one step takes {startup['wall']:.2f} s from start to end, "
                 f"as a member of a sweep {member:.2f} s.")
    return lines


def block_of_tetrahedra(n):
    return (f"mesh.box.cells=[{n},{n},{n}]", 'mesh.box.cell="tetrahedron"', "time.end=0.02", "time.steps=2")


def compare_blocks(folder, quick):
    """The twisted block: the body factorised and iterated, beside the peer's two forms."""
    rows = []
    for n in (8,) if quick else (16, 24):
        ours, folders = {}, {body: pathlib.Path(folder) / body for body in ("direct", "iterative")}
        for body, into in folders.items():
            print(f"peer in 3D: n = {n}, {body}", flush=True)
            ours[body] = median_of(3, lambda: run_case(BLOCK, into, *block_of_tetrahedra(n), f'solver.body="{body}"'))
        for form, solver in (("conjugate gradients", "cg"), ("MUMPS", "auto")):
            print(f"peer in 3D: n = {n}, {form}", flush=True)
            theirs = measured_peer(BLOCK_PEER, n, 2, folder, "--solver", solver)
            rows.append((n, form, ours, theirs, [agreed(into, folder, 1e-8, n) for into in folders.values()]))
    return rows


def block_table(rows):
    lines = ["| n, GetFEM by | unknowns, T / G | Tourmaline, s: direct / iterative | GetFEM, s |"
             " whole process: over direct / iterative |"
             " per step | Newton, T direct / T iterative / G | peak MiB, the same | largest difference: direct / iterative |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for n, form, ours, theirs, differences in rows:
        runs = ours.values()
        peer_step = theirs["seconds"]["steps"] / theirs["steps"]
        cells = [f"{n}, {form}", [ours["direct"]["summary"]["sizes"]["unknowns"], theirs["unknowns"]],
                 [f"{run['wall']:.2f}" for run in runs], f"{theirs['wall']:.2f}",
                 [f"{theirs['wall'] / run['wall']:.1f}" for run in runs],
                 [f"{peer_step / (steps_only(run) / theirs['steps']):.0f}" for run in runs],
                 [sum(run["newton"]) for run in runs] + [sum(theirs["newton_iterations"])],
                 [mebibytes(run["summary"]["memory"]) for run in runs] + [mebibytes(theirs["peak_rss_bytes"])],
                 [f"{difference:.1e}" for difference in differences]]
        lines.append("| " + " | ".join(" / ".join(map(str, c)) if isinstance(c, list) else c for c in cells) + " |")
    return lines


def floors(sizes, machine):
    """Seconds: reading the factor twice, and the operations of the factorisation at the DGEMM rate."""
    return 2 * 8 * sizes["factor_entries"] / machine["read_bandwidth"], sizes["factor_flops"] / machine["dgemm_rate"]


def a_step(summary):
    """Seconds of a step, without the estimates of errors that the first makes and few others."""
    step = summary["seconds"]["step"]
    return (step["total"] - step["estimates"]) / summary["sizes"]["steps"]


def growth(folder, machine, quick):
    runs = []
    for n in (64, 128, 256) if quick else (64, 128, 256, 512):
        print(f"growth: n = {n}", flush=True)
        runs.append((n, median_of(3 if n < 512 else 1, lambda: tourmaline(n, 20, folder))))
    lines = ["| n | unknowns | mesh, s | assemble | analyse | factorise | errors estimated | step, ms | of it substitutions | contact |"
             " step over floor | factorise over DGEMM | peak MiB | Newton first, mean after |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for n, run in runs:
        seconds, sizes = run["summary"]["seconds"], run["summary"]["sizes"]
        step, steps = seconds["step"], sizes["steps"]
        floor, dgemm = floors(sizes, machine)
        lines.append(
            f"| {n} | {sizes['unknowns']} | {seconds['mesh']:.3f} | {seconds['assemble']:.3f} | "
            f"{seconds['analyse']:.3f} | {seconds['factorise']:.3f} | {step['estimates']:.3f} | {1e3 * a_step(run['summary']):.2f} | "
            f"{1e3 * step['substitutions'] / steps:.2f} | {1e3 * step['contact'] / steps:.2f} | "
            f"{a_step(run['summary']) / floor:.1f} | {seconds['factorise'] / dgemm:.1f} | "
            f"{mebibytes(run['summary']['memory'])} | {run['newton'][0]}, {statistics.mean(run['newton'][1:]):.1f} |")
    first, last = runs[0][1]["summary"], runs[-1][1]["summary"]
    ratio = math.log(last["sizes"]["unknowns"] / first["sizes"]["unknowns"])

    def exponent(value):
        return math.log(value(last) / value(first)) / ratio
    lines += ["", f"Exponents against unknowns, first to last row: set-up {exponent(lambda s: set_up(s['seconds'])):.2f}, "
              f"step {exponent(a_step):.2f}, "
              f"memory {exponent(lambda s: s['memory']):.2f}."]
    at_256 = next(run for n, run in runs if n == 256)["summary"]["seconds"]
    share = (at_256["start"] + at_256["mesh"] + at_256["assemble"]) / (at_256["analyse"] + at_256["factorise"])
    bound = at_256["analyse"] + at_256["factorise"] + at_256["step"]["substitutions"]
    lines += ["", f"At n = 256, start-up, mesh and assembly together are {100 * share:.0f} % of analysis and factorisation, "
              f"and the whole run takes {at_256['total'] / bound:.2f} times what analysis, factorisation and the "
              f"substitutions of its 20 steps take."]
    return lines


def factorised(folder, case, count, *overrides):
    """The same run by the program's own factorisation, by it with two threads, and by MUMPS."""
    def measured(into, kind, threads):
        run = run_case(case, into, *overrides, f'solver.factorisation="{kind}"', f"solver.threads={threads}", core=f"0-{threads - 1}")
        seconds = run["summary"]["seconds"]
        return {**run, "factorise": seconds["factorise"], "step": a_step(run["summary"]), "nodes": pathlib.Path(into) / "nodes.csv"}
    runs = {}
    for name, kind, threads in (("own", "own", 1), ("both cores", "own", 2), ("MUMPS", "mumps", 1)):
        into = pathlib.Path(folder) / name
        runs[name] = median_of(count, lambda: measured(into, kind, threads))
    return runs


def factorisations(folder, machine, quick):
    lines = ["| | factorise, s: own / MUMPS | ratio | own over DGEMM | a step, ms: own / MUMPS | ratio | own over floor |"
             " both cores: factorise, step | peak MiB, own / MUMPS | largest difference |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    plane = [(f"2D, n = {n}", CASE, 3 if n < 512 else 1, (f"mesh.box.cells=[{n},{n}]", "time.steps=20"))
             for n in ((128, 256) if quick else (128, 256, 512))]
    solid = [(f"3D, n = {n}", BLOCK, 1, (f"mesh.box.cells=[{n},{n},{n}]", 'mesh.box.cell="tetrahedron"', "time.end=0.2",
                                         "time.steps=20")) for n in ((16,) if quick else (24, 32))]
    for name, case, count, overrides in plane + solid:
        print(f"factorisations: {name}", flush=True)
        runs = factorised(folder, case, count, *overrides)
        own, both, mumps = runs["own"], runs["both cores"], runs["MUMPS"]
        floor, dgemm = floors(own["summary"]["sizes"], machine)
        lines.append(
            f"| {name} | {own['factorise']:.3f} / {mumps['factorise']:.3f} | {own['factorise'] / mumps['factorise']:.2f} | "
            f"{own['factorise'] / dgemm:.1f} | "
            f"{1e3 * own['step']:.1f} / {1e3 * mumps['step']:.1f} | "
            f"{own['step'] / mumps['step']:.2f} | {own['step'] / floor:.1f} | "
            f"{own['factorise'] / both['factorise']:.2f}, {own['step'] / both['step']:.2f} times faster | "
            f"{mebibytes(own['summary']['memory'])} / {mebibytes(mumps['summary']['memory'])} | "
            f"{largest_difference(own['nodes'], mumps['nodes']):.1e} |")
    return lines


def sweep_start(folder):
    """Seconds that a member of a sweep of small cases takes, one after the other."""
    members = 20
    seconds, _ = on_one_core([PROGRAM, "sweep", CASE, "--vary", f"contact.friction.bound=lin:1e4:1e5:{members}", "--jobs", 1, "-q",
                              "-o", pathlib.Path(folder) / "sweep", "--set", "mesh.box.cells=[2,2]", "--set", "time.steps=1",
                              "--set", "output.fields=false", "--set", "output.report=false"])
    return seconds / members


def solids(folder, quick):
    """A block of tetrahedra, two steps: the factorisation and the iterative solution."""
    lines = ["| n | unknowns | body | set-up, s | step, s | linear iterations, all | of one solve | Newton, all | peak MiB |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for n in (8, 16, 24) if quick else (8, 16, 24, 32, 48):
        for body in ("direct", "iterative"):
            if n == 48 and body == "direct":
                continue  # about 13 GiB and minutes
            print(f"solids: n = {n}, {body}", flush=True)
            summary = run_case(BLOCK, folder, *block_of_tetrahedra(n), f'solver.body="{body}"')["summary"]
            lines.append(f"| {n} | {summary['sizes']['unknowns']} | {body} | {set_up(summary['seconds']):.2f} | "
                         f"{a_step(summary):.2f} | {summary['iterations'].get('krylov_total', '')} | "
                         f"{summary['iterations'].get('krylov_max', '')} | {summary['iterations']['newton_total']} | {mebibytes(summary['memory'])} |")
    return lines


def side_by_side(run, count=2):
    """Independent runs at once, each in a folder of its own: what the machine gives to one when both work."""
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(count) as pool:
        return max(pool.map(lambda i: run(pathlib.Path(folder) / str(i), core=i), range(count)), key=lambda r: r["wall"])


def scaling(folder, n):
    """One rank, two, and two runs of one rank at once; the median of three of factorisation and steps."""
    def measured(into=folder, ranks=1, core=0):
        run = run_case(CASE, into, f"mesh.box.cells=[{n},{n}]", "time.steps=20", ranks=ranks, core=core)
        seconds = run["summary"]["seconds"]
        return {"wall": seconds["factorise"] + seconds["step"]["total"], "factorise": seconds["factorise"],
                "step": a_step(run["summary"])}
    print(f"ranks: n = {n}", flush=True)
    one, two, twice = (median_of(3, run) for run in (measured, lambda: measured(ranks=2), lambda: side_by_side(measured)))
    return ["Factorisation and 20 steps, n = %d in 2D. Two runs that know nothing of each other show what the machine" % n,
            "leaves to each of two; dividing the work without any cost would take half of their time.", "",
            "| | factorisation, s | a step, ms | together, s | one rank over it |", "| --- | --- | --- | --- | --- |"] + [
            f"| {name} | {r['factorise']:.2f} | {1e3 * r['step']:.0f} | {r['wall']:.1f} | {one['wall'] / r['wall']:.2f} |"
            for name, r in (("one rank", one), ("two ranks", two))] + [
            f"| two runs at once | {twice['factorise']:.2f} | {1e3 * twice['step']:.0f} | {twice['wall']:.1f} | "
            f"half of it: {2 * one['wall'] / twice['wall']:.2f} |"]


def long_run(folder):
    print("2,000 steps", flush=True)
    short, long = tourmaline(128, 20, folder), tourmaline(128, 2000, folder)
    return ["", f"2,000 steps at n = 128: {long['wall']:.1f} s, peak {mebibytes(long['summary']['memory'])} MiB; "
            f"20 steps: {mebibytes(short['summary']['memory'])} MiB."]


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True).stdout.strip()


def heading(machine, versions):
    with open("/proc/cpuinfo") as cpuinfo:
        processor = next(line.split(":")[1].strip() for line in cpuinfo if line.startswith("model name"))
    return ["# Benchmarks", "",
            "Written by `./dev bench`. The paper's conductive case, one thread, one core, field files off; times are wall",
            "clock, medians of three where a run is short. Ratios are GetFEM over Tourmaline. `bench/peers/README.md` says",
            "what the peer does and why these are its strongest settings, and what it would gain from another ordering.", "",
            f"Commit {git('rev-parse', '--short', 'HEAD')}{' and changes' if git('status', '--porcelain', '-uno') else ''}; "
            f"{processor}, {platform.system()}; reads {machine['read_bandwidth'] / 1e9:.1f} GB/s, DGEMM "
            f"{machine['dgemm_rate'] / 1e9:.1f} Gflop/s on one core, takes memory anew at {machine['taking_anew'] / 1e9:.2f} GB/s; load average at the start {os.getloadavg()[0]:.1f}.", "",
            "; ".join(f"{name} {version}" for name, version in versions.items()) + ".", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    quick = parser.parse_args().quick
    machine = json.loads(on_one_core([BUILD / "bench" / "machine"])[1])
    with tempfile.TemporaryDirectory() as folder:
        startup = median_of(3, lambda: tourmaline(2, 1, folder))
        text = heading(machine, startup["summary"]["versions"])
        text += ["## Beside GetFEM", ""] + comparison_table(compare(folder, quick), startup, sweep_start(folder))
        text += ["", "## Beside GetFEM in three dimensions", "",
                 "`cases/block-3d/twisted.toml` on n x n x n cubes of tetrahedra, two steps of 0.01 s. GetFEM's unknowns have the",
                 "multipliers with them. A step of Tourmaline's direct solution has the factorisation behind it; GetFEM solves the",
                 "whole system in each Newton iteration, by conjugate gradients, its fastest form, or by MUMPS' LDL^T.", ""]
        text += block_table(compare_blocks(folder, quick))
        text += ["", "## Floors and growth", "",
                 "The floor of a step is reading the factor twice at the bandwidth above; that of the factorisation its",
                 "operations at the DGEMM rate.", ""] + growth(folder, machine, quick)
        if not quick:
            text += long_run(folder)
        text += ["", "## Own factorisation and MUMPS", "",
                 "The same runs with `solver.factorisation` \"own\" and \"mumps\", the first also with `solver.threads = 2` on two",
                 "cores; factorisations are a run's first and only one. A virtual machine that has given memory back must be given it",
                 "anew, at the rate above. 3D: the block below, 20 steps.", ""]
        text += factorisations(folder, machine, quick)
        text += ["", "## Three dimensions", "",
                 "`cases/block-3d/twisted.toml` on n x n x n cubes of tetrahedra, two steps of 0.01 s.", ""] + solids(folder, quick)
        text += ["", "## Ranks", ""] + scaling(folder, 256 if quick else 512)
    (ROOT / "bench" / "results.md").write_text("\n".join(text) + "\n")
    print("\n".join(text))


main()
