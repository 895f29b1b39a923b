# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where detect_planes writes: pipes, files that the shell has opened, and links. What signals leave of its files: nothing."""

import os
import re
from pathlib import Path

from support import CLOUD, CUBE, HAS_VIEW, NO_POINTS, NOTHING, WARNS, cases, ply, table

RUN = "$P cube.ply $E"
SUMMARY = "hash +[0-9a-f]+\n"
OPTIONS = ["output", "labels", "planes", "vg", "polygons", "report"] + HAS_VIEW * ["view"]
OUTPUT_FILES = dict(zip(OPTIONS, ("o.ply", "o.labels", "o.planes", "o.vg", "o.obj", "o.json", "o.html")))
ESCAPE, BELL, CSI, HIGH = b"\033", b"\007", b"\302\233", b"\233"
NAME = "Wände ".encode() + ESCAPE + b"[31m" + BELL + CSI + HIGH


def prepare(p):
    p(0, NOTHING, "cube.ply E --quiet --planes planes")
    p.write({"slow.xyz": "".join(f"{i % 109} {i % 97} {i % 3}\n" for i in range(20000)),
             # The plain PCA of many neighbors takes seconds, and does not look for signals.
             "signals.sh": """start() {
               $P slow.xyz --quiet --maximum-distance .5 --estimate-normals $* 2> messages & pid=$!
               until [ $(find . -name '*.part*' | wc -l) -ge $parts ] && [ -d $folder ]; do sleep .01; done
             }
             parts=2 folder=. files="--output never.ply --labels never.labels"
             end() { code=0; wait $pid 2> /dev/null || code=$?; echo $code $(cat messages); }
             """})


@table("before, after, command", [
    # What the shell has opened is not replaced.
    ("", SUMMARY, f"{RUN} --planes /dev/stdout > log"),
    ("old\n", SUMMARY, f"{RUN} --planes log >> log"),
    ("old\nthree\n", "end\n", f"exec 3>> log; echo three >&3; {RUN} --quiet --planes /dev/fd/3; echo end >&3"),
    ("old\n", SUMMARY, f"ln -s /dev/stdout my_output; {RUN} --planes my_output >> log"),
    # Pipes
    ("", "", f"{RUN} --quiet --planes /dev/fd/1 | cat > log"),
    ("", "", f"mkfifo fifo; cat fifo > log & {RUN} --quiet --planes fifo; wait"),
    ("", "", f"{{ {RUN} --quiet --planes /dev/fd/5 5>&1 >&2 | cat; }} > log")])  # as in a process substitution
def test_opened_files(p, before, after, command):
    p.write({"log": "old\n"})
    p.shell(0, NOTHING, command)
    assert re.fullmatch(f"{before}.*{re.escape(p.read('planes'))}.*{after}", p.read("log"), re.DOTALL)


@table("pattern, command", [
    (r"\A-?[0-9.]+[^\n]*\n\Z", f"{RUN} --planes /dev/stdout | head -1"),
    (f'"hash".*{SUMMARY}', f"{RUN} --planes /dev/stdout --report /dev/stdout | cat"),
    (NOTHING, f"ln -s link2 link; mkdir sub; ln -s sub/new link2; {RUN} --quiet --planes link && cmp sub/new planes && "
     "[ -L link2 ] && cmp link planes && [ -L link ] && rm link"),
    (NOTHING, f"name=$(printf '%0250d' 7); {RUN} --quiet --planes $name && cmp $name planes")])
def test_names_of_outputs(p, pattern, command):
    p.shell(0, pattern, command)


test_no_dash = cases([
    *((f"--{option} is '-', must be the name of a file .that of standard output is /dev/stdout", f"cube.ply --{option} -")
      for option in ("output", "labels", "report")), ("--polygons is '-', must end in", "cube.ply --polygons -"),
    ("INPUT is '-', must be the name of a file", "- E")], 2, absent=["-"])


def test_links(p):
    p.path("to_nowhere").symlink_to("nowhere")
    p.path("LOOP").symlink_to("LOOP")
    p(2, "named twice", "cube.ply E --planes nowhere --labels to_nowhere")
    p(1, "LOOP: cannot be written .Too many", "cube.ply E --planes LOOP")
    p(2, "named twice", "cube.ply E --planes LOOP/x --labels LOOP/./x")
    assert p.path("LOOP").is_symlink()


def test_modes(p):
    """A file that is replaced keeps its own mode, a new one has that of the shell."""
    files = " ".join(f"--{option} {file}" for option, file in OUTPUT_FILES.items())
    places = [p.path(name) for name in [*OUTPUT_FILES.values(), "modes/cube.ply"]]
    p.path("modes").mkdir()
    for mode in (0o600, 0o640, 0o644, 0o444):
        for path in places:
            path.write_text("")
            path.chmod(mode)
        p(0, NOTHING, f"cube.ply --quiet E {files} --output-directory modes")
        for path in places:
            assert path.stat().st_size > 0 and path.stat().st_mode & 0o777 == mode, path
            path.unlink()
    p.shell(0, NOTHING, f"umask 027; {RUN} --quiet {files}")
    assert {path.stat().st_mode & 0o777 for path in places[:-1]} == {0o640}


@table("code, arguments", [
    (1, [b"no " + NAME]), (1, ["cube.ply", "--output", NAME + b"/x.ply"]), (2, ["cube.ply", b"--" + NAME]),
    *((2, ["cube.ply", "--" + option, NAME]) for option in ("output", "classes", "columns", "fixed-direction", "threads")),
    (WARNS, ["cube.ply", b"none " + NAME + b".ply", "E"]), (0, [NAME + b".ply", "E", "--report", "names.json"])])
def test_names_with_any_bytes(p, code, arguments):
    """None controls a terminal."""
    for name, content in ((b"%s.ply", ply(CLOUD, CUBE)), (b"none %s.ply", ply(NO_POINTS))):
        Path(os.fsdecode(bytes(p.folder) + b"/" + name % NAME)).write_text(content)
    text = p(code, "", arguments).encode(errors="surrogateescape")
    assert not re.search(b"[\033\007\233]", text), "control characters"
    if code == 0:
        assert r"Wände \x1b[31m\x07\xc2\x9b\x9b.ply".encode() in text
        assert r'"input": "W\u00e4nde \u001b[31m\u0007\u009b\u009b.ply"' in p.read("names.json")


# Bytes of no character: continuations, forms that are too long, surrogates, beyond the last one, cut off
NO_TEXT = (b"\x80 \xff \xc0\x81 \xe0\x9f\xbf \xed\xa0\x80 \xf0\x8f\xbf\xbf "
           b"\xf4\x90\x80\x80 \xf5\x80\x80\x80 \xe2\x82 \xf0\x9f\x98")


@table("name, shown", [
    (text.encode(), text) for text in ("€ 中 \U0001f600", "\u00a0\u07ff\u0800\ud7ff\ue000\U0010ffff")] + [
    (b"a\nb\t\342\200\256c\330\234\342\201\246d\x7f", r"a\x0ab\x09\xe2\x80\xaec\xd8\x9c\xe2\x81\xa6d\x7f"),
    (NO_TEXT, "".join(chr(c) if c == 32 else rf"\x{c:02x}" for c in NO_TEXT))])
def test_what_is_shown_of_names(p, name, shown):
    """Characters of UTF-8, but for those that change the direction of text"""
    p(1, re.escape(shown + ".ply: no such file"), [name + b".ply"])


@table("pattern, command", [
    (r"\A1 detect_planes: interrupted[^\n]*\n\Z", "start 100 $files; kill -HUP $pid; end"),
    (r"\A130\n\Z", "start 1000 $files; kill -INT $pid; sleep .1; kill -INT $pid; end"),
    (r"\A152\n\Z", "ulimit -c 0; start 1000 $files; kill -XCPU $pid; end"),
    (r"\A130\n\Z",
     "parts=1 folder=new/d; start 1000 --output-directory new/d --planes p; kill -INT $pid; sleep .1; kill -INT $pid; end"),
    (r"\A\Z", f"{{ sleep .1; {RUN} --output never.ply --planes /dev/stdout; }} | true"),
    (r"\A0\n\Z", "trap '' HUP; start 100 $files; kill -HUP $pid; end; rm never.ply never.labels")])  # as nohup
def test_signals(p, pattern, command):
    p.shell(0, pattern, f". ./signals.sh; {command}")
    assert not p.has("never.ply", "never.labels", "new", "p")
