"""MATLAB files against scipy's reader and writer, another implementation.

    check_mat.py PROGRAM
"""
import csv
import struct
import sys
import zlib

from blocks import SMALL_STUDY, Folder, skip_without

skip_without("numpy", "scipy")
import numpy as np
import scipy.io

with Folder(sys.argv[1]) as folder:
    (folder.path / "small.json").write_text(SMALL_STUDY)
    path = lambda name: str(folder.path / name)
    folder.shell("gyrostat simulate small.json --cell still --out rec.csv")
    folder.shell("gyrostat simulate small.json --cell still --out rec.mat")
    with open(path("rec.csv")) as file:
        reader = csv.DictReader(file)
        rows = list(reader)
    recording = scipy.io.loadmat(path("rec.mat"))
    names = [name for name in recording if not name.startswith("__")]
    assert set(names) == set(reader.fieldnames), names
    for name in names:
        assert np.array_equal(recording[name].ravel(), [float(row[name]) for row in rows]), name

    folder.shell("gyrostat apply rec.mat --out comp.mat && gyrostat apply rec.csv --out comp.csv")
    with open(path("comp.csv")) as file:
        rows = list(csv.DictReader(file))
    comp = scipy.io.loadmat(path("comp.mat"))
    blank = lambda text: float(text) if text else np.nan
    assert np.array_equal(comp["kf_ma_estimate_dps"].ravel(), [blank(r["kf_ma_estimate_dps"]) for r in rows])
    legend = [str(cell[0]) for cell in comp["kf_ma_status_names"].ravel()]
    status = [legend[int(k) - 1] for k in comp["kf_ma_status"].ravel()]
    assert status == [r["kf_ma_status"] for r in rows]

    # Lengths that are stated are those that are there: scipy does not look, Octave does.
    whole, at = open(path("comp.mat"), "rb").read(), 128
    while at < len(whole):
        kind, size = struct.unpack_from("<II", whole, at)
        element = whole[at:at + 8 + size] if kind == 14 else zlib.decompress(whole[at + 8:at + 8 + size])
        assert struct.unpack_from("<II", element) == (14, len(element) - 8), at
        at += 8 + size

    # Written by scipy in the layouts that loggers have: all are the same recording to `allan`.
    # The first table; the others bear the file's name.
    curve = lambda said: said.split("\n\n")[0].split("\n", 2)[2:]
    expected = curve(folder.shell("gyrostat allan rec.csv --format csv"))
    columns = {name: recording[name] for name in ("t_s", "gyro_dps", "temperature_C") if name in recording}
    row_vectors = {name: values.T for name, values in columns.items()}
    scipy.io.savemat(path("plain.mat"), columns)
    scipy.io.savemat(path("packed.mat"), row_vectors, do_compression=True)
    scipy.io.savemat(path("struct.mat"), {"rec": columns, "note": "text", "fs": 50.0})
    gyro = np.radians(recording["gyro_dps"].ravel())
    scipy.io.savemat(path("other.mat"), {"log": {"Time": 1000 * recording["t_s"],
                                                 "Gyro": np.column_stack([0 * gyro, 0 * gyro, gyro])}})
    for name in ("plain.mat", "packed.mat", "struct.mat"):
        assert curve(folder.shell(f"gyrostat allan {name} --format csv")) == expected, name
    other = folder.shell("gyrostat allan other.mat --columns 't=Time[ms],gyro=Gyro(:,3)' --units gyro=rad/s --format csv")
    numbers = lambda lines: np.array([[float(x) for x in line.split(",")] for line in "\n".join(lines).split() if "," in line])
    assert np.allclose(numbers(curve(other)), numbers(expected), rtol=1e-9, atol=0)

    scipy.io.savemat(path("version4.mat"), columns, format="4")
    folder.shell("gyrostat allan version4.mat", expected=2)
    whole = open(path("packed.mat"), "rb").read()
    flipped = bytearray(whole)
    flipped[len(whole) // 3] ^= 0x55
    for broken in (b"", b"no such thing", whole[:200], whole[: len(whole) // 2], whole[:-3], bytes(flipped)):
        open(path("broken.mat"), "wb").write(broken)
        folder.shell("gyrostat allan broken.mat", expected=2)
print("scipy and the program read each other's MATLAB files")
