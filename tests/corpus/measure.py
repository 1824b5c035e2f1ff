#!/usr/bin/env python3
"""Measures trimloop over a folder of real IGES files and sets it against OpenCASCADE in the same run.

usage: tests/corpus/measure.py [--corpus DIR] [--trimloop PROGRAM] [--out DIR] [--only TEXT] [--stages a,b,...]

Stages: info      opens? faces and their states, area (against OCCT's reference figures), an independent face count
        bytes     fix --none gives the same bytes
        mesh      STL at the reference's deflection in mm, judged by mesh_check (two-sided distance)
        export    convert to IGES; read by OCCT (faces, area) and by ourselves
        speed     in-process and whole-process times, ours and OCCT's, one after the other
Needs the corpus with its occt_reference.jsonl and, for mesh, export and speed, the two measuring programs of its
tools folder, which are compiled on first use. One line of JSON per file goes to OUT/results.jsonl, the summary to
OUT/summary.md and standard output.
"""
import argparse, json, math, os, re, subprocess, sys, time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ANGLE_RAD = 0.5  # occt_peer's default
OCCT_LIBS = ("TKIGES TKSTEP TKSTEPBase TKSTEPAttr TKSTEP209 TKXSBase TKMesh TKTopAlgo TKShHealing TKBRep TKGeomAlgo "
             "TKGeomBase TKG3d TKG2d TKMath TKernel").split()


def run(command, limit=120, errors=False):
    """(exit code, stdout or stderr, seconds); exit code None on a time-out."""
    start = time.perf_counter()
    try:
        done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, b"", time.perf_counter() - start
    return done.returncode, done.stderr if errors else done.stdout, time.perf_counter() - start


def json_line(text):
    for line in text.decode("utf-8", "replace").splitlines():
        if line.startswith("{"):
            try:
                return json.loads(line)
            except ValueError:
                return None
    return None


def build_tool(tools, name, out):
    program = out / name
    source = tools / f"{name}.cpp"
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        subprocess.run(["g++", "-O2", "-w", "-std=c++17", "-I/usr/include/opencascade", source, "-o", program]
                       + [f"-l{lib}" for lib in OCCT_LIBS], check=True)
    return program


def tokens_of(text):
    """Fields of one record's parameter text (default delimiters), Hollerith strings as None."""
    fields, at = [], 0
    while at < len(text):
        hollerith = re.match(rb"\s*(\d+)H", text[at:at + 16])
        if hollerith:
            at += hollerith.end() + int(hollerith.group(1))
            fields.append(None)
            cut = re.compile(rb"[,;]").search(text, at)
        else:
            cut = re.compile(rb"[,;]").search(text, at)
            fields.append(text[at:cut.start() if cut else len(text)].strip())
        if not cut or cut.group() == b";":
            break
        at = cut.end()
    return fields


def face_count(path):
    """Faces by the directory section and the pointers of the records that own surfaces, written without our library:
    each 144, 143 and 510, each bounded plane (108 form 1) and each surface that no other record uses, once per placement
    (308/408)."""
    data = path.read_bytes().replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    lines = data.split(b"\n") if b"\n" in data else [data[i:i + 80] for i in range(0, len(data), 80)]
    directory, parameters = [], {}
    for line in lines:
        letter = line[72:73].upper()
        if letter == b"D":
            directory.append(line[:72])
        elif letter == b"P":
            parameters[int(line[73:80].strip() or b"0")] = line[:64]
    entries = {}
    for i in range(0, len(directory) - 1, 2):
        try:
            first, count = int(directory[i][8:16]), int(directory[i + 1][24:32].strip() or b"0")
            entries[i + 1] = (int(directory[i][:8]), int(directory[i + 1][32:40].strip() or b"0"),
                              tokens_of(b"".join(parameters.get(k, b"") for k in range(first, first + count))))
        except ValueError:
            pass
    pointer = lambda fields, k: int(fields[k]) if len(fields) > k and fields[k] and fields[k].lstrip(b"-").isdigit() else 0
    surfaces = {108, 114, 118, 120, 122, 128, 140, 190, 192, 194, 196, 198}
    used, members, uses = set(), {}, {}
    for de, (kind, form, fields) in entries.items():
        if kind in (144, 510):
            used.add(pointer(fields, 1))
        elif kind == 143:
            used.add(pointer(fields, 2))
        elif kind == 141:
            used.add(pointer(fields, 3))
        elif kind == 142:
            used.add(pointer(fields, 2))
        elif kind == 140:
            used.add(pointer(fields, 5))
        elif kind == 402 and form == 9:  # one parent plane and its holes
            used.update(pointer(fields, k) for k in range(4, 4 + pointer(fields, 2)))
        elif kind == 308:
            members[de] = [pointer(fields, k) for k in range(4, 4 + pointer(fields, 3))]
        elif kind == 408:
            uses[de] = pointer(fields, 1)
        elif kind == 186:
            members[de] = [pointer(fields, 1)] + [pointer(fields, 4 + 2 * k) for k in range(pointer(fields, 3))]
        elif kind == 514:
            members[de] = [pointer(fields, 2 + 2 * k) for k in range(pointer(fields, 1))]

    def one(de):
        kind, form, _ = entries.get(de, (0, 0, []))
        if kind in (143, 144, 510):
            return 1
        if kind == 108:
            return int(form == 1 and de not in used)
        return int(kind in surfaces and de not in used)

    def expanded(de, depth):
        kind = entries.get(de, (0,))[0]
        if depth < 40 and kind in (186, 408, 514):
            return sum(expanded(m, depth + 1) for m in members.get(uses.get(de, de), []))
        return one(de)

    inside = {m for list_ in members.values() for m in list_}
    return sum(expanded(de, 0) for de in entries if de not in inside)


def measure(path, reference, args, tools):
    row = {"path": str(path.relative_to(args.corpus))}
    out = args.out / "files"
    stem = row["path"].replace("/", "_")
    code, text, seconds = run([args.trimloop, "info", "--json", path])
    row["info_code"] = code
    info = json_line(text)
    if info:
        row.update(faces=info["model"]["faces"], healed=info["model"]["faces_healed"], failed=info["model"]["faces_failed"],
                   area=info["model"]["area"], findings=info["findings"], info_seconds=seconds,
                   volume=info["model"]["volume"], bbox=info["model"]["bbox"])
    if row.get("healed"):  # each healed face states its area after (measured) and before (limit), or why it cannot
        _, text, _ = run([args.trimloop, "check", "--json", path])
        areas = [f for f in (json_line(text) or {}).get("findings", []) if f["id"] == "MD-30"]
        row["healed_stated"] = len({f["entity"] for f in areas})
        row["healed_both"] = sum(f["measured"] is not None and f["limit"] is not None for f in areas)
    row["counted"] = face_count(path)
    row["occt"] = {k: reference.get(k) for k in ("faces", "area", "area_plain", "defl", "diag", "triangles", "solids", "volume", "fault")}
    if "bytes" in args.stages:
        target = out / (stem + ".same")
        code, _, _ = run([args.trimloop, "fix", "--none", "--force", "-q", path, target])
        row["same_bytes"] = code == 0 and target.read_bytes() == path.read_bytes()
        target.unlink(missing_ok=True)
    has_faces = bool(info and info["model"]["faces"] and reference.get("faces"))
    if has_faces and ("mesh" in args.stages or "speed" in args.stages):
        defl = reference["defl"]
        stl, report = out / (stem + ".stl"), out / (stem + ".json")
        convert = [args.trimloop, "convert", "--force", "-q", "--deflection", repr(defl), "--angle",
                   repr(math.degrees(ANGLE_RAD)), path, stl]
        code, _, _ = run(convert + ["--timings", "--report", report], args.patience)
        row["mesh_code"] = code
        if code == 0:
            r = json.loads(report.read_text())
            row.update(triangles=r["triangles"], max_bound=r["max_bound"], open_edges=r["open_edges"], ours_ms=r["milliseconds"],
                       mesh_failed=sum(f["status"] == "failed" for f in r["faces"]))
            if "mesh" in args.stages:
                code, text, _ = run([tools["mesh_check"], path, stl], 3 * args.patience)
                check = json_line(text)
                if check:
                    row["mesh_to_ref"] = check["mesh_to_ref"] * check["diag"] / defl if check["mesh_to_ref"] is not None else None
                    row["ref_to_mesh"] = check["ref_to_mesh"] * check["diag"] / defl if check["ref_to_mesh"] is not None else None
                    row["worst_missing"] = check["worst_missing"]
            if "speed" in args.stages:
                pairs = []
                for _ in range(3):
                    _, text, theirs = run([tools["occt_peer"], path, repr(defl / reference["diag"]), repr(ANGLE_RAD)], 300)
                    peer = json_line(text)
                    # Without a report: that would measure the areas of healed faces on the way.
                    code, words, ours = run([w for w in convert if w != "-q"] + ["--timings"], errors=True)
                    ms = re.search(rb"; read ([\d.]+) import ([\d.]+) sew ([\d.]+) mesh ([\d.]+)", words)
                    if not peer or code != 0 or not ms:
                        break
                    pairs.append((sum(float(ms.group(k)) for k in (1, 2, 3, 4)),
                                  1e3 * (peer["t_read"] + peer["t_transfer"] + peer["t_mesh"]), 1e3 * ours, 1e3 * theirs))
                if pairs:
                    row["speed"] = {name: sorted(p[i] for p in pairs)[len(pairs) // 2]
                                    for i, name in enumerate(("ours_ms", "occt_ms", "ours_whole_ms", "occt_whole_ms"))}
        stl.unlink(missing_ok=True)
    if has_faces and "export" in args.stages:
        target = out / (stem + ".igs")
        code, _, _ = run([args.trimloop, "convert", "--force", "-q", path, target])
        row["export_code"] = code
        if code == 0:
            _, text, _ = run([tools["occt_peer"], target, "1e-2"], 300)
            peer = json_line(text)
            if peer:
                row["export_occt"] = {"faces": peer["faces"], "area": peer["area"]}
            _, text, _ = run([args.trimloop, "info", "--json", target])
            again = json_line(text)
            if again:
                row["export_ours"] = {"faces": again["model"]["faces"], "area": again["model"]["area"],
                                      "failed": again["model"]["faces_failed"]}
            if not args.keep:
                target.unlink(missing_ok=True)
    return row


def close(a, b, tolerance):
    return a is not None and b is not None and abs(a - b) <= tolerance * max(abs(a), abs(b), 1e-300)


def share(good, all_):
    return f"{len(good)} of {len(all_)}" + (f" ({100 * len(good) / len(all_):.1f} %)" if all_ else "")


def summarize(rows, stages):
    lines, notes = [], []
    def line(name, good, all_, key):
        lines.append(f"| {name} | {share(good, all_)} |")
        bad = [r for r in all_ if r not in good]
        if bad:
            notes.append((name, [f"{r['path']}: {key(r)}" for r in bad]))
    # A file that opens with a model exits 0; a refusal must carry a fatal finding.
    opened = [r for r in rows if r["info_code"] == 0]
    line("files that open with a model", opened, rows, lambda r: f"exit {r['info_code']}, findings {r.get('findings')}")
    with_faces = [r for r in rows if r.get("faces")]
    total = sum(r["faces"] for r in with_faces)
    failed = sum(r["failed"] for r in with_faces)
    lines.append(f"| faces: all / healed / failed | {total} / {sum(r['healed'] for r in with_faces)} / {failed} ({100 * failed / max(total, 1):.2f} %) |")
    healed = [r for r in with_faces if r["healed"]]
    lines.append(f"| healed faces that state their area before and after / or why not / all | "
                 f"{sum(r.get('healed_both', 0) for r in healed)} / "
                 f"{sum(r.get('healed_stated', 0) - r.get('healed_both', 0) for r in healed)} / {sum(r['healed'] for r in healed)} |")
    line("faces counted by the directory = reported", [r for r in opened if r["counted"] == r.get("faces", 0)], opened,
         lambda r: f"counted {r['counted']}, reported {r.get('faces')}")
    # Where OCCT's two integrals differ, or its area is not positive (unbounded and failed faces), it is no reference.
    judged = [r for r in rows if r["occt"].get("faces") and (r["occt"]["area"] or 0) > 0
              and close(r["occt"]["area"], r["occt"]["area_plain"], 1e-4)]
    line("area within 1e-4 of OCCT where its two integrals agree", [r for r in judged if close(r.get("area"), r["occt"]["area"], 1e-4)],
         judged, lambda r: f"ours {r.get('area')}, OCCT {r['occt']['area']}, faces {r.get('faces')} / {r['occt']['faces']}")
    if "bytes" in stages:
        line("fix --none byte-identical", [r for r in rows if r.get("same_bytes")], [r for r in rows if r["info_code"] in (0, 1)], lambda r: "differs")
    if "mesh" in stages:
        meshed = [r for r in judged]
        worst = lambda r: max(r.get("mesh_to_ref") or math.inf, r.get("ref_to_mesh") or math.inf)
        good = [r for r in meshed if r.get("mesh_to_ref") is not None and r.get("ref_to_mesh") is not None
                and max(r["mesh_to_ref"], r["ref_to_mesh"]) <= 1.2]
        line("two-sided distance <= 1.2 x deflection", good, meshed,
             lambda r: f"mesh to ref {r.get('mesh_to_ref')}, ref to mesh {r.get('ref_to_mesh')} deflections, worst at {r.get('worst_missing')}")
    if "export" in stages:
        line("export read by OCCT: same faces, area within 1e-6 of what it read from the original",
             [r for r in judged if r.get("export_occt") and r["export_occt"]["faces"] == r["occt"]["faces"]
              and close(r["export_occt"]["area"], r["occt"]["area"], 1e-6)], judged,
             lambda r: f"{r.get('export_occt')} against faces {r['occt']['faces']}, area {r['occt']['area']}")
        exported = [r for r in rows if "export_code" in r]
        line("export read by ourselves: same faces, area within 1e-6",
             [r for r in exported if r.get("export_ours") and r["export_ours"]["faces"] == r["faces"]
              and close(r["export_ours"]["area"], r["area"], 1e-6)], exported,
             lambda r: f"{r.get('export_ours')} against faces {r['faces']}, area {r['area']}")
    if "speed" in stages:
        fair = [r for r in rows if r.get("speed") and r.get("faces") == r["occt"]["faces"]
                and max(r.get("mesh_to_ref") or 0, r.get("ref_to_mesh") or 0) <= 1.2]
        if fair:
            ratios = [r["speed"]["ours_ms"] / r["speed"]["occt_ms"] for r in fair]
            geo = math.exp(sum(map(math.log, ratios)) / len(ratios))
            lines.append(f"| in-process read + import + mesh, ours / OCCT, geometric mean over {len(fair)} files | {geo:.3f} |")
            slow = sorted((r for r in fair if r["speed"]["occt_whole_ms"] >= 50), key=lambda r: -r["speed"]["occt_whole_ms"])[1:]
            if slow:
                whole = sum(r["speed"]["ours_whole_ms"] for r in slow) / sum(r["speed"]["occt_whole_ms"] for r in slow)
                lines.append(f"| whole process, sum over {len(slow)} files (OCCT >= 50 ms, largest left out) | {whole:.3f} |")
            tri = [(r["triangles"], r["occt"]["triangles"]) for r in fair if r.get("triangles")]
            lines.append(f"| triangles, ours / OCCT (sum) | {sum(a for a, _ in tri) / sum(b for _, b in tri):.3f} |")
            notes.append(("slowest ratios", [f"{r['path']}: {r['speed']['ours_ms']:.1f} / {r['speed']['occt_ms']:.1f} ms = {q:.2f}, triangles {r['triangles']} / {r['occt']['triangles']}, {r['ours_ms']}"
                                             for q, r in sorted(zip(ratios, fair), key=lambda p: -p[0])[:12]]))
    text = "| what | result |\n|---|---|\n" + "\n".join(lines) + "\n"
    for name, bad in notes:
        text += f"\n**{name}** - the others:\n" + "".join(f"- {b}\n" for b in bad[:60])
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=Path, default=Path(os.environ.get("TRIMLOOP_CORPUS", ROOT.parent / "shared" / "corpus")))
    parser.add_argument("--tools", type=Path, default=None, help="folder of occt_peer.cpp and mesh_check.cpp")
    parser.add_argument("--trimloop", type=Path, default=ROOT / "build" / "dev" / "cli" / "trimloop")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "corpus")
    parser.add_argument("--only", default="", help="only files whose path holds this text")
    parser.add_argument("--stages", default="info,bytes,mesh,export,speed")
    parser.add_argument("--patience", type=float, default=60, help="seconds for one conversion")
    parser.add_argument("--keep", action="store_true", help="keep exported files")
    args = parser.parse_args()
    args.stages = args.stages.split(",")
    if not (args.corpus / "occt_reference.jsonl").exists():
        print(f"skipped: no corpus at {args.corpus}")
        return 0
    (args.out / "files").mkdir(parents=True, exist_ok=True)
    tools = {}
    if {"mesh", "export", "speed"} & set(args.stages):
        folder = args.tools or args.corpus.parent / "tools"
        tools = {name: build_tool(folder, name, args.out) for name in ("occt_peer", "mesh_check")}
    references = {}
    for text in (args.corpus / "occt_reference.jsonl").read_text().splitlines():
        entry = json.loads(text)
        if entry["path"].startswith("iges/") and args.only in entry["path"]:
            references[entry["path"]] = entry
    rows = []
    with open(args.out / "results.jsonl", "w") as results:
        for i, (name, reference) in enumerate(sorted(references.items())):
            rows.append(measure(args.corpus / name, reference, args, tools))
            results.write(json.dumps(rows[-1]) + "\n")
            results.flush()
            if sys.stderr.isatty():
                print(f"\r{i + 1}/{len(references)} {name[-60:]:<60}", end="", file=sys.stderr)
    text = summarize(rows, args.stages)
    (args.out / "summary.md").write_text(text)
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
