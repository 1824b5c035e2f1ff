#!/usr/bin/env python3
"""The same mesh from every build: each program meshes each file with one and with two threads, and the bytes are compared.

usage: tests/corpus/same_bytes.py [--build] [--programs PROGRAM...] [--only TEXT] [FILE...]

--build configures and builds the program four times (g++, clang++-14; -O0, -O3) below build/same_bytes, and compares
these. Files: those given, else the public IGES corpus. Exit 1 when any two results differ.
"""
import argparse, hashlib, subprocess, sys, tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def build():
    programs = []
    for compiler in ("g++", "clang++-14"):
        for level in ("-O0", "-O3"):
            where = ROOT / "build" / "same_bytes" / (compiler + level)
            subprocess.run(["cmake", "-S", ROOT, "-B", where, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}",
                            "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={level} -DNDEBUG", "-DTRIMLOOP_BUILD_TESTS=OFF",
                            "-DTRIMLOOP_BUILD_SAMPLES=OFF", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"], check=True)
            subprocess.run(["cmake", "--build", where, "-j2", "--target", "trimloop"], check=True)
            programs.append(where / "cli" / "trimloop")
    return programs


def mesh(program, file, jobs, out, limit):
    """The hash of what `convert` writes, or how it ended without."""
    out.unlink(missing_ok=True)
    try:
        done = subprocess.run([program, "convert", file, out, "--quiet", "--jobs", str(jobs)], capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return "timeout"
    return hashlib.sha256(out.read_bytes()).hexdigest() if out.exists() else f"exit {done.returncode}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", type=Path, nargs="*")
    parser.add_argument("--build", action="store_true")
    parser.add_argument("--programs", type=Path, nargs="+", default=[ROOT / "build" / "dev" / "cli" / "trimloop"])
    parser.add_argument("--corpus", type=Path, default=ROOT.parent / "shared" / "corpus" / "iges")
    parser.add_argument("--only", default="")
    parser.add_argument("--limit", type=float, default=60, help="seconds a file and program")
    args = parser.parse_args()
    programs = build() if args.build else args.programs
    files = args.files or sorted(p for p in args.corpus.rglob("*") if p.suffix.lower() in (".igs", ".iges"))
    same = meshed = skipped = different = 0
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            if args.only not in str(file):
                continue
            results = {(str(p), jobs): mesh(p, file, jobs, Path(folder) / "out.obj", args.limit)
                       for p in programs for jobs in (1, 2)}
            if "timeout" in results.values():
                skipped += 1
            elif len(set(results.values())) == 1:
                same += 1
                meshed += len(next(iter(results.values()))) == 64
            else:
                print(f"DIFFERS {file}")
                for (program, jobs), result in results.items():
                    print(f"   {result[:16]}  --jobs {jobs}  {program}")
                different += 1
    print(f"{len(programs)} programs, 1 and 2 threads: {same} files with the same result ({meshed} of them with a mesh), "
          f"{different} different, {skipped} over the time limit")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
