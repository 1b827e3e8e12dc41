#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the start of hpvi is made of, and what would shorten it: start_up.py PROGRAM DIRECTORY. Puts into DIRECTORY empty libraries in the
place of those that Debian's deal.II is linked with and hpvi never calls, and a copy of deal.II whose own symbols are bound beforehand, and
runs the program with them by LD_LIBRARY_PATH. Prints rows of a table. An experiment: nothing is installed or linked."""
import os
import pathlib
import re
import resource
import struct
import subprocess
import sys

# What deal.II offers readers of CAD files and of meshes, and its other solvers. Adol-C stays: deal.II calls it before main begins.
UNUSED = re.compile(r"lib(TK\w+|gmsh|assimp|petsc_real|slepc_real|sundials_\w+)\.so")
FUNCTIONS = set("TWtw")  # letters of nm


def output(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout


def symbols(library, which):
    """Letters by names."""
    words = [line.split() for line in output("nm", "-D", which, library).splitlines()]
    return {line[-1].split("@")[0]: line[-2] for line in words}


def empty_libraries(dealii, libraries, home):
    """Libraries with the names of the unused ones, and of their symbols those that deal.II asks for: functions that return 0, zeros."""
    home.mkdir(parents=True, exist_ok=True)
    asked = symbols(dealii, "--undefined-only")
    for name in re.findall(r"NEEDED.*\[(.*)\]", output("readelf", "-d", dealii)):
        if not UNUSED.match(name):
            continue
        text = ['.section .note.GNU-stack,"",@progbits']
        for symbol, letter in symbols(libraries[name], "--defined-only").items():
            if symbol in asked and letter in FUNCTIONS:
                text += [".text", f".globl {symbol}", f".type {symbol},@function", f"{symbol}: xorl %eax,%eax", "ret"]
            elif symbol in asked:
                text += [".data", f".globl {symbol}", f".type {symbol},@object", f".size {symbol},256", f"{symbol}: .zero 256"]
        source = home / "empty.s"
        source.write_text("\n".join(text) + "\n")
        subprocess.run(["gcc", "-shared", "-nostdlib", "-o", home / name, f"-Wl,-soname,{name}", source], check=True)


def bound_copy(dealii, home):
    """A copy in which relocations by symbols of the library itself hold their addresses, as -Bsymbolic would have made it."""
    home.mkdir(parents=True, exist_ok=True)
    data = bytearray(pathlib.Path(dealii).read_bytes())
    table, (size, count, names) = struct.unpack_from("<Q", data, 0x28)[0], struct.unpack_from("<HHH", data, 0x3A)
    sections = [struct.unpack_from("<IIQQQQIIQQ", data, table + k * size) for k in range(count)]

    def name(section):
        begin = sections[names][4] + section[0]
        return data[begin:data.index(b"\0", begin)].decode()

    by_name = {name(section): section for section in sections}
    relocations, dynamic_symbols = by_name[".rela.dyn"], by_name[".dynsym"]
    absolute, global_data, relative, unique = 1, 6, 8, 10
    for place in range(relocations[4], relocations[4] + relocations[5], 24):
        offset, info, addend = struct.unpack_from("<QQq", data, place)
        if info & 0xffffffff not in (absolute, global_data):
            continue
        _, kind, _, section, value, _ = struct.unpack_from("<IBBHQQ", data, dynamic_symbols[4] + (info >> 32) * 24)
        if section and kind >> 4 != unique and kind & 15 in (1, 2):
            struct.pack_into("<QQq", data, place, offset, relative, value + (addend if info & 0xffffffff == absolute else 0))
    (home / pathlib.Path(dealii).name).write_bytes(data)


def measure(command, path):
    """CPU seconds, the least of ten, as the machine may be busy."""
    best, environment = None, {**os.environ, "LD_LIBRARY_PATH": path, "OMP_NUM_THREADS": "1"}
    for _ in range(10):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        best = used if best is None else min(best, used)
    return best


def main():
    program, home = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    libraries = dict(re.findall(r"(\S+) => (\S+)", output("ldd", program)))
    dealii = next(str(pathlib.Path(path).resolve()) for name, path in libraries.items() if name.startswith("libdeal.ii"))
    empty_libraries(dealii, libraries, home / "empty")
    bound_copy(dealii, home / "bound")
    scene = [program, "prm/han-6-12.prm", "--output", str(home / "scene"), "--set", "Error/Bound=false", "--set", "Adaptivity/Maximum steps=8"]
    for words, path in (("as it is", ""), ("empty libraries for what hpvi never calls", f"{home}/empty"),
                        ("deal.II's own symbols bound beforehand", f"{home}/bound"), ("both", f"{home}/bound:{home}/empty")):
        environment = {**os.environ, "LD_LIBRARY_PATH": path}
        count = len(subprocess.run(["ldd", program], env=environment, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines())
        told = subprocess.run([program, "--version"], env={**environment, "LD_DEBUG": "statistics"}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True, check=True).stderr
        relocations = int(re.search(r"number of relocations: (\d+)", told)[1])
        print(f"| {words} | {count} | {relocations} | {measure([program, '--version'], path):.2f} | {measure(scene, path):.2f} |", flush=True)


main()
