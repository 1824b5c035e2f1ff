#!/usr/bin/env python3
"""Edit one random parameter of every public IGES file, write, compare.

What the bytes must be afterwards is computed here, from the cards alone, without a line of the program's code: the data of
the entity's cards from the changed parameter on, laid out again at parameter borders; when that takes a card more or
less, the numbers of the cards behind, the Parameter pointers behind, the card count and the Terminate card's count.

    tests/corpus/edit.py --program build/dev/cli/trimloop [--times 1] [--seed 1]
"""
import argparse, os, pathlib, random, re, subprocess, sys, tempfile


class Cards:
    """A file of 80-column lines; None of it is understood but where cards stand."""

    def __init__(self, data):
        self.data = data
        self.lines = data.splitlines(keepends=True)
        self.bodies = [re.sub(rb"[\r\n]+$", b"", line) for line in self.lines]
        if any(len(b) < 80 for b in self.bodies[: self.end()]):
            raise ValueError("not in lines of 80 columns")
        self.section = {c: [i for i in range(self.end()) if self.bodies[i][72:73] == c] for c in (b"S", b"G", b"D", b"P")}
        if [int(self.bodies[i][73:80]) for i in self.section[b"P"]] != list(range(1, len(self.section[b"P"]) + 1)):
            raise ValueError("Parameter cards are not numbered from 1")
        text = b"".join(self.bodies[i][:72] for i in self.section[b"G"])
        first = re.match(rb"\s*(?:1H(.)|)(?P<d>.)?", text)
        self.pd = first.group(1) or b","
        rest = text[len(first.group(0)):] if first.group(1) else text[1:]
        second = re.match(rb"\s*1H(.)", rest)
        self.rd = second.group(1) if second else b";"

    def end(self):
        for i, body in enumerate(self.bodies):
            if body[72:73] == b"T":
                return i
        return len(self.bodies)

    def entities(self):
        d = self.section[b"D"]
        for k in range(0, len(d) - 1, 2):
            one, two = self.bodies[d[k]], self.bodies[d[k + 1]]
            try:
                yield k + 1, d[k], d[k + 1], int(one[8:16]), int(two[24:32])
            except ValueError:
                continue


def split(text, pd, rd):
    """(begin, first non-blank, delimiter) of every parameter."""
    out, at = [], 0
    while True:
        first = at
        while first < len(text) and text[first:first + 1] == b" ":
            first += 1
        string = re.match(rb"(\d+)[Hh]", text[first:])
        scan = first + len(string.group(0)) + int(string.group(1)) if string else first
        while scan < len(text) and text[scan:scan + 1] not in (pd, rd):
            scan += 1
        if scan >= len(text):
            raise ValueError("no end")
        out.append((at, min(first, scan), scan))
        if text[scan:scan + 1] == rd:
            return out
        at = scan + 1


def expected(cards, entity, index, new):
    de, d1, d2, pointer, count = entity
    lines = [cards.section[b"P"][pointer - 1 + i] for i in range(count)]
    text = b"".join(cards.bodies[i][:64] for i in lines)
    tokens = split(text, cards.pd, cards.rd)
    begin, first, delimiter = tokens[index]
    start = first // 64
    end = delimiter // 64 + 1
    k = index + 1
    while k < len(tokens) and tokens[k][1] // 64 < end:
        end = max(end, tokens[k][2] // 64 + 1)
        k += 1

    def lead(t):
        return text[max(t[0], t[1] // 64 * 64):t[1]]

    units = [(lead(tokens[index]) + new + text[delimiter:delimiter + 1], len(new) >= 64)]
    for t in tokens[index + 1:k]:
        units.append((lead(t) + text[t[1]:t[2] + 1], t[1] // 64 != t[2] // 64))
    if k == len(tokens):
        tail = text[tokens[-1][2] + 1:].rstrip(b" ")
        if tail:
            units.append((tail, True))
            end = max(end, (tokens[-1][2] + len(tail)) // 64 + 1)
    out, line = [], text[start * 64:max(begin, start * 64)]
    for unit, cuttable in units:
        if len(line) + len(unit) > 64 and not cuttable and line:
            out.append(line)
            line, unit = b"", unit.lstrip(b" ")
        while len(line) + len(unit) > 64:
            room = 64 - len(line)
            out.append(line + unit[:room])
            line, unit = b"", unit[room:]
        line += unit
    if line:
        out.append(line)

    delta = len(out) - (end - start)
    model = lines[end - 1]

    def number(old, value):
        return str(value).encode().rjust(len(old), b"0" if old[:1] == b"0" else b" ")

    def with_field(body, a, b, change):
        return body[:a] + number(body[a:b], int(body[a:b]) + change) + body[b:]

    result = list(cards.lines)
    for i, data in enumerate(out[: end - start]):
        at = lines[start + i]
        result[at] = data.ljust(64) + cards.lines[at][64:]
    if delta:
        behind = pointer - 1 + end
        for at in cards.section[b"P"][behind:]:
            result[at] = with_field(result[at], 73, 80, delta)
        for other in cards.entities():
            if other[3] > behind:
                result[other[1]] = with_field(result[other[1]], 8, 16, delta)
        result[d2] = with_field(result[d2], 24, 32, delta)
        if cards.end() < len(result):
            result[cards.end()] = with_field(result[cards.end()], 25, 32, delta)
        if delta < 0:
            for i in range(start + len(out), end):
                result[lines[i]] = b""
        else:
            old = cards.bodies[model]
            line_end = cards.lines[model][len(cards.bodies[model]):]
            extra = b"".join(
                data.ljust(64) + old[64:73] + number(old[73:80], pointer + start + i) + line_end
                for i, data in enumerate(out) if i >= end - start)
            result[model] += extra
    return b"".join(result)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="build/dev/cli/trimloop")
    parser.add_argument("--corpus", default=os.environ.get("TRIMLOOP_CORPUS", "../shared/corpus"))
    parser.add_argument("--times", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    done = same = skipped = refused = 0
    moved = 0
    for path in sorted(pathlib.Path(options.corpus, "iges").rglob("*")):
        if not path.is_file():
            continue
        data = path.read_bytes()
        for _ in range(options.times):
            try:
                cards = Cards(data)
                entity = chance.choice(list(cards.entities()))
                lines = [cards.section[b"P"][entity[3] - 1 + i] for i in range(entity[4])]
                tokens = split(b"".join(cards.bodies[i][:64] for i in lines), cards.pd, cards.rd)
                reals = [i for i in range(1, len(tokens))]
                index = chance.choice(reals)
            except (ValueError, IndexError):
                skipped += 1
                continue
            value = chance.choice([b"0.25", b"-17.123456789012345", b"1.E-20", b"3.", b"7"])
            with tempfile.TemporaryDirectory() as folder:
                out = pathlib.Path(folder, "out.igs")
                run = subprocess.run([options.program, "fix", "--raw", "--set", f"D{entity[0]}:{index}={value.decode()}", str(path), str(out)],
                                     capture_output=True, timeout=60)
                if run.returncode != 0:
                    refused += 1
                    print(f"{path.name} D{entity[0]}:{index}: {run.stderr.decode(errors='replace').strip()[:150]}")
                    continue
                got = out.read_bytes()
            done += 1
            wanted = expected(cards, entity, index, value)
            moved += len(wanted) != len(data)
            if got == wanted:
                same += 1
            else:
                at = next((i for i in range(min(len(got), len(wanted))) if got[i] != wanted[i]), min(len(got), len(wanted)))
                print(f"{path.name} D{entity[0]}:{index}={value.decode()}: differs from byte {at}")
    print(f"{done} edits, {same} as computed, {moved} of them with a card more or less; {refused} refused, {skipped} without lines of 80 columns")
    return 0 if same == done else 1


if __name__ == "__main__":
    sys.exit(main())
