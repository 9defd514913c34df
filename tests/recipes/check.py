"""The recipes of CONTRIBUTING.md, carried out: one file each, nothing else touched, little compiled.

    check.py SOURCE_DIR BUILD_DIR

Copies sources and build, drops the files of tree/ into the copy, builds the program there and uses each of them. The
copy stands at a path of the same length, so that what ninja knows of the build (.ninja_deps) can be re-rooted
in place, and its rules are marked as generators' rules, which ninja does not run again for a changed command
alone (ninja manual, "rule variables"). What is built then is what the new files call for.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE, BUILD = Path(os.path.abspath(sys.argv[1])), Path(os.path.abspath(sys.argv[2]))
TREE = Path(__file__).resolve().parent / "tree"

# Objects for all recipes together. The filter: one of the sources that describe filters. The effect: the source that
# describes effects, and those that work on effects by type. Lens and metric: the one that describes them. Verb and
# picture: themselves and the list of all. And the one that says which commit this is.
MOST_OBJECTS = 16

if not (BUILD / "build.ninja").exists() or SOURCE not in BUILD.parents:
    print("SKIPPED: needs a build by ninja inside the source tree")
    sys.exit(0)

start = time.monotonic()


def tell(what):
    print(f"{time.monotonic() - start:6.1f} s  {what}", flush=True)


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def same_length_path():
    """A fresh folder whose path is as long as that of the sources."""
    base = Path(tempfile.gettempdir()).resolve()
    fill = len(str(SOURCE)) - len(str(base)) - 1
    if fill < 4:
        base, fill = Path("/tmp"), len(str(SOURCE)) - 5
    path = base / f"{os.getpid():x}".rjust(fill, "r")[-fill:]
    path.mkdir()
    return path


def patch(path, change):
    """Changes a file's bytes and keeps its time, which ninja goes by."""
    stat, old = path.stat(), path.read_bytes()
    new = change(old)
    if new != old:
        path.write_bytes(new)
        os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))


def reroot(text):
    return text.replace(str(SOURCE).encode(), str(copy).encode())


copy = same_length_path()
try:
    build = copy / BUILD.relative_to(SOURCE)
    build.mkdir(parents=True)
    for name in ("CMakeLists.txt", "cmake", "core", "generators", "analysis", "results", "recordings", "diagnosis",
                 "experiments", "python", "package.json", "package-lock.json", "node_modules"):
        if (SOURCE / name).exists():
            run("cp", "-a", SOURCE / name, copy)
    kept = [entry for entry in BUILD.iterdir()
            if entry.suffix == ".a" or entry.name in ("CMakeCache.txt", "CMakeFiles", "generated", "include", "gyrostat",
                                                      ".ninja_deps", ".ninja_log")]
    run("cp", "-a", *kept, build)
    for path in [build / "CMakeCache.txt", build / ".ninja_deps", *build.rglob("*.cxx"), *build.rglob("*.cmake")]:
        patch(path, reroot)
    link = build / "include" / "gyrostat"
    link.unlink()
    link.symlink_to(copy)
    tell("copied")

    dropped = []
    for path in sorted(TREE.rglob("*")):
        into = copy / path.relative_to(TREE)
        if path.is_file() and into.parent.exists():  # where the diagnosis has a file an effect
            if into.exists():
                sys.exit(f"{into} is there already")
            shutil.copyfile(path, into)
            dropped.append(str(into))

    run("cmake", "-S", copy, "-B", build, "-DGYROSTAT_BUILD_TESTS=OFF", "-DGYROSTAT_BUILD_BENCHMARKS=OFF",
        "-DGYROSTAT_PYTHON=OFF", f"-DGYROSTAT_COMPILED_ALONE={';'.join(dropped)}")
    patch(build / "CMakeFiles" / "rules.ninja",
          lambda text: re.sub(rb"(?m)^rule (\w*(COMPILER|LINKER)\w*)$", rb"rule \1\n  generator = 1", text))
    # What is new is compiled quickly rather than made quick.
    patch(build / "build.ninja", lambda text: text.replace(b"-O3", b"-O0"))
    tell("configured")
    built = re.findall(r"Building CXX object (\S+)", run("ninja", "-C", build, "-j2", "gyrostat"))
    tell(f"built {len(built)} objects:\n  " + "\n  ".join(sorted(built)))
    assert 0 < len(built) <= MOST_OBJECTS, f"{len(built)} objects were compiled"
    assert not any("kernels" in name for name in built), "packed kernels were compiled"

    program, work = build / "gyrostat", copy / "work"
    work.mkdir()
    study = {"cells": [{
        "name": "switching", "trials": 12,
        "scenario": {
            "duration_s": 200, "rate_hz": 20, "effects": [{"effect": "square_wave"}],
            "random_error": {"phi": 0.5, "delta1_dps": 1e-4, "measurement_noise_std_dps": 0.02}},
        "filters": ["none", "kf", {"filter": "windowed_mean", "parameters": {"window": 20}}]}]}
    (work / "study.json").write_text(json.dumps(study))

    def gyrostat(*words):
        said = run(program, *words, cwd=work)
        tell("gyrostat " + " ".join(words))
        return said

    for kind, name in (("filters", "windowed_mean"), ("effects", "square_wave"), ("lenses", "wander_over_time"),
                       ("metrics", "heading_drift")):
        assert name in gyrostat("list", kind), f"{name} is not listed"
    gyrostat("run", "study.json")
    assert "windowed_mean" in gyrostat("rank", "runs/study", "--metric", "heading_drift"), "the filter or metric"
    assert gyrostat("count", "runs/study") == "switching: 12\n", "the verb"
    assert "count" in run(program, "--help").split("completion")[-1], "a new verb stands at the end"
    gyrostat("report", "runs/study")
    assert "The median of each method" in (work / "runs/study/report.html").read_text(), "the picture"
    gyrostat("simulate", "study.json", "--out", "REC.csv")
    gyrostat("diagnose", "REC.csv", "--json", "GAP.json", "--html", "GAP.html")
    assert "Wandering over time" in (work / "GAP.html").read_text(), "the lens"
    assert "square_wave" in (work / "GAP.json").read_text(), "the effect, as a cause"
finally:
    shutil.rmtree(copy, ignore_errors=True)
