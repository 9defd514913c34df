"""Every verb's --help has examples, whose options exist; completion knows what the program knows.

    check_help.py PROGRAM
"""
import re
import subprocess
import sys

from blocks import Folder

program = sys.argv[1]
failures = []


def said(*words):
    return subprocess.run([program, *words], capture_output=True, text=True).stdout


verbs = re.findall(r"^  ([a-z][a-z-]+) ", said("--help").split("Subcommands:")[1], re.M)
assert len(verbs) >= 20, verbs
helps = {verb: said(verb, "--help") for verb in verbs}
options = {verb: set(re.findall(r"--[a-z][a-z-]*", text.split("Examples:")[0])) for verb, text in helps.items()}
for verb, text in helps.items():
    own = [line for line in text.splitlines() if re.search(rf"\bgyrostat {verb}( |\)|$)", line)]
    if "Examples:" not in text or not own:
        failures.append(f"{verb}: no example in its --help")
    # Each piece of a line that calls the program: its verb and options exist.
    for called in re.findall(r"\bgyrostat ([a-z][a-z-]*)([^&|>)]*)", text.split("Examples:")[-1]):
        words = re.split(r"   +", called[1])[0]
        if called[0] not in verbs:
            failures.append(f"{verb}: an example calls '{called[0]}'")
            continue
        for option in re.findall(r"(?<!\S)--[a-z][a-z-]*", words):
            if option not in options[called[0]]:
                failures.append(f"{verb}: an example has {option}, which {called[0]} has not")

with Folder(program) as folder:
    (folder.path / "study.json").write_text("{}")

    def completed(asked):
        """What is offered behind each of the lines, asked of one shell."""
        script = "source <(gyrostat completion bash)\n"
        for words in asked:
            line = " ".join(f"'{word}'" for word in words)
            script += (f"COMP_WORDS=(gyrostat {line}); COMP_CWORD={len(words)}; COMPREPLY=(); _gyrostat\n"
                       "echo \"${COMPREPLY[@]}\"\n")
        return [set(offered.split()) for offered in folder.shell(script).splitlines()]

    expectations = [
        (("",), set(verbs) | {"--help", "--version"}),
        (("val",), {"validate"}),
        (("run", "st"), {"study.json"}),
        (("run", "x", "--format", ""), {"text", "md", "csv", "json", "latex"}),
        (("apply", "x", "--fit", "li"), {"likelihood"}),
        (("diagnose", "x", "--without", "outl"), {"outliers"}),
        (("diagnose", "x", "--json", "st"), {"study.json"}),
        (("list", "eff"), {"effects"}),
        (("completion", ""), {"bash", "zsh", "fish"})]
    expectations += [((verb, "--"), options[verb]) for verb in verbs]
    offered = completed([words for words, _ in expectations])
    assert len(offered) == len(expectations), offered
    for (words, expected), got in zip(expectations, offered):
        if got != expected:
            failures.append(f"completion of {words}: {sorted(got ^ expected)} too few or too many")
    fish = said("completion", "fish")
    for verb in verbs:
        for option in options[verb]:
            if f"from {verb}' -l {option[2:]} " not in fish:
                failures.append(f"completion for fish lacks {option} of {verb}")

print("\n".join(failures) or f"{len(verbs)} verbs have examples and are completed")
sys.exit(1 if failures else 0)
