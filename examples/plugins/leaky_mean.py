"""The same filter as a process in Python: gyrostat run STUDY.json --filter-command "python3 leaky_mean.py" """
import array, json, math, sys

print(json.dumps({"protocol": 1, "name": "python_mean", "title": "leaky mean, in Python", "parameters": [
    {"name": "time_constant", "unit": "samples", "from": 1, "default": 50, "meaning": "memory of the mean"}]}), flush=True)
while header := sys.stdin.buffer.read(16):
    kind, count = map(int, array.array("d", header))
    numbers = array.array("d", sys.stdin.buffer.read(8 * count * (1 if kind == 0 else 6)))
    if kind == 0:  # a new trial, and the parameters
        gain, mean = 1 / numbers[0], 0.0
        continue
    answer = array.array("d", [count])  # to a block of samples
    for gyro in numbers[1::6]:
        innovation = gyro - mean
        missing = math.isnan(innovation)
        mean += 0 if missing else gain * innovation
        answer.extend((mean, math.nan, innovation, math.nan, 1 if missing else 0))
    sys.stdout.buffer.write(answer)
    sys.stdout.buffer.flush()
