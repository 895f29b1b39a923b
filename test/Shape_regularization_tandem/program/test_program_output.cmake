# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Where detect_planes writes: pipes, files that the shell has opened, and links. What signals leave of its files:
# nothing. PROGRAM is tested in WORK_DIR.

cmake_minimum_required(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

expect(0 "^$" cube.ply ${epsilon} --quiet --planes planes)
file(READ "${WORK_DIR}/planes" planes)
set(run "\"$P\" cube.ply --maximum-distance 0.004")

# expect_planes(before after command): what the command writes to the file log.
macro(expect_planes before after command)
  file(WRITE "${WORK_DIR}/log" "old\n")
  expect_shell(0 "^$" "${command}")
  file(READ "${WORK_DIR}/log" log)
  if(NOT "${log}" MATCHES "^${before}(.*)$" OR NOT "${log}" MATCHES "${after}$")
    complain("${command}\n  strange log: ${log}")
  endif()
  string(FIND "${log}" "${planes}" found)
  if(found LESS 0)
    complain("${command}\n  no planes in the log: ${log}")
  endif()
endmacro()

# --- What the shell has opened is not replaced
set(summary "hash +[0-9a-f]+\n")
if(EXISTS /dev/stdout)
  expect_planes("old\n" "" "${run} --quiet --planes /dev/stdout >> log")
  expect_planes("old\n" "${summary}" "${run} --planes /dev/stdout >> log")
  expect_planes("" "${summary}" "${run} --planes /dev/stdout > log")
  expect_planes("old\n" "${summary}" "${run} --planes log >> log")
  expect_planes("old\nthree\n" "end\n" "exec 3>> log; echo three >&3; ${run} --quiet --planes /dev/fd/3; echo end >&3")
  expect_planes("old\n" "${summary}" "ln -s /dev/stdout my_output; ${run} --planes my_output >> log")

  # --- Pipes
  expect_planes("" "" "${run} --quiet --planes /dev/stdout | cat > log")
  expect_planes("" "" "${run} --quiet --planes /dev/fd/1 | cat > log")
  expect_planes("" "" "mkfifo fifo; cat fifo > log & ${run} --quiet --planes fifo; wait")
  expect_planes("" "" "{ ${run} --quiet --planes /dev/fd/5 5>&1 >&2 | cat; } > log") # as in a process substitution
  expect_shell(0 "^-?[0-9.]+[^\n]*\n$" "${run} --planes /dev/stdout | head -1")
  expect_shell(0 "\"hash\".*${summary}" "${run} --planes /dev/stdout --report /dev/stdout | cat")
endif()

# --- Names
foreach(option IN ITEMS output labels planes vg report)
  expect(2 "--${option} is '-', must be the name of a file .that of standard output is /dev/stdout" cube.ply --${option} -)
endforeach()
foreach(option IN ITEMS polygons shapes mesh view)
  expect(2 "--${option} is '-', must end in" cube.ply --${option} -)
endforeach()
expect(2 "INPUT is '-', must be the name of a file" - ${epsilon})
expect_no_file(-)
set(planes_of_link "cmp link planes && [ -L link ] && rm -f link")
expect_shell(0 "^$" "ln -s target link; ${run} --quiet --planes link && cmp target planes && ${planes_of_link}")
expect_shell(0 "^$" "ln -s link2 link; mkdir sub; ln -s sub/new link2; ${run} --quiet --planes link &&
  cmp sub/new planes && [ -L link2 ] && ${planes_of_link}")
expect_shell(0 "^$" "name=$(printf '%0250d' 7); ${run} --quiet --planes $name && cmp $name planes")
expect_shell(2 "named twice" "ln -s nowhere link; exec ${run} --planes nowhere --labels link")
expect_shell(1 "LOOP/y: cannot be written .Too many" "ln -s LOOP LOOP; exec ${run} --planes LOOP/x --labels LOOP/y")
expect_shell(1 "LOOP: cannot be written .Too many" "exec ${run} --planes LOOP")
expect_shell(2 "named twice" "exec ${run} --planes LOOP/x --labels LOOP/./x")
expect_shell(0 "^$" "[ -L LOOP ]")

# --- Modes: a file that is replaced keeps its own, a new one has that of the shell
file(WRITE "${WORK_DIR}/modes.sh" [=[
mode() { ls -l "$1" | cut -c 1-10; }
for option in output:o.ply labels:o.labels planes:o.planes vg:o.vg polygons:o.obj report:o.json view:o.html; do
  file=${option#*:}
  "$P" --help | grep -q -e "--${option%:*} " || continue
  for mode in 600 640 644 444; do
    : > $file; chmod $mode $file; before=$(mode $file)
    "$P" cube.ply --quiet --maximum-distance 0.004 --${option%:*} $file
    [ -s $file ] && [ "$(mode $file)" = "$before" ] || echo "$file: $(mode $file) instead of $before"
    chmod u+w $file
  done
  rm $file
  (umask 027; "$P" cube.ply --quiet --maximum-distance 0.004 --${option%:*} $file)
  [ "$(mode $file)" = "-rw-r-----" ] || echo "$file: $(mode $file), which is new"
done
mkdir modes; : > modes/cube.ply; chmod 600 modes/cube.ply
"$P" cube.ply --quiet --maximum-distance 0.004 --output-directory modes
[ -s modes/cube.ply ] && [ "$(mode modes/cube.ply)" = "-rw-------" ] || mode modes/cube.ply
]=])
expect_shell(0 "^$" ". ./modes.sh")

# --- Names of files may have any bytes: those of UTF-8 stay, and none controls a terminal
file(WRITE "${WORK_DIR}/names.sh" [=[
escape=$(printf '\033') bell=$(printf '\007') csi=$(printf '\302\233') high=$(printf '\233')
name="Wände ${escape}[31m$bell$csi$high"
check() { if LC_ALL=C grep -q "$escape\|$bell\|$csi\|$high" log; then echo "$1 has control characters"; fi; }
cp cube.ply "$name.ply"
"$P" "$name.ply" --quiet --maximum-distance 0.004 --report names.json; check 'empty log'
"$P" "$name.ply" --maximum-distance 0.004 > log 2>&1; check summary
grep -q 'Wände .x1b.31m.x07.xc2.x9b.x9b.ply' log || cat log
try() { "$P" "$@" > log 2>&1 && echo 'no error'; check "the message for $2"; }
cp cube.ply "$name.doc"
try "no $name"
try "$name.doc"
try "$name.ply" --output "./$name.ply"
try "$name.ply" --output-directory .
try cube.ply --output "$name/x.ply"
for option in output view mesh backend classes columns fixed-direction threads "$name"; do try cube.ply --$option "$name"; done
try cube.ply "--$name"
printf 'ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n' \
  > "none $name.ply"
"$P" cube.ply "none $name.ply" --maximum-distance 0.004 > log 2>&1; check warning
lines=$(printf 'a\nb\342\200\256c\330\234\342\201\246d') # and what changes the direction of a text
"$P" "$lines.ply" 2> log
grep -q 'a.x0ab.xe2.x80.xaec.xd8.x9c.xe2.x81.xa6d.ply: no such file' log || cat log
]=])
expect_shell(0 "^$" ": > log; . ./names.sh")
file(READ "${WORK_DIR}/names.json" report)
string(JSON name ERROR_VARIABLE json_error GET "${report}" input)
if(NOT "${report}" MATCHES "\"input\": \"W.u00e4nde .u001b.31m.u0007.u009b.u009b.ply\"")
  complain("the name in the report: ${name} ${json_error}")
endif()

# --- Signals. The plain PCA of many neighbors takes seconds, and does not look for them.
file(WRITE "${WORK_DIR}/signals.sh" [=[
awk 'BEGIN { for(i = 0; i < 20000; ++i) print i % 109, i % 97, i % 3 }' > slow.xyz
start()
{
  "$P" slow.xyz --quiet --maximum-distance .5 --estimate-normals $1 --output never.ply --labels never.labels 2> messages &
  pid=$!
  while [ $(find . -name '*.part*' | wc -l) -lt 2 ]; do sleep .01; done
}
end() { code=0; wait $pid 2> /dev/null || code=$?; echo $code $(cat messages); }
]=])
set(start ". ./signals.sh; start")
expect_shell(0 "^1 detect_planes: interrupted[^\n]*\n$" "${start} 100; kill -HUP $pid; end")
expect_shell(0 "^130\n$" "${start} 1000; kill -INT $pid; sleep .1; kill -INT $pid; end")
expect_shell(0 "^143\n$" "${start} 1000; kill -INT $pid; sleep .1; kill -TERM $pid; end")
expect_shell(0 "^152\n$" "ulimit -c 0; ${start} 1000; kill -XCPU $pid; end")
expect_shell(0 "^0\n$" "trap '' HUP; ${start} 100; kill -HUP $pid; end") # as nohup
file(APPEND "${WORK_DIR}/signals.sh" [=[
start_in_folder()
{
  "$P" slow.xyz --quiet --maximum-distance .5 --estimate-normals 1000 --output-directory new/folder --planes p 2> messages &
  pid=$!
  while [ ! -d new/folder ] || [ $(find . -name '*.part*' | wc -l) -lt 1 ]; do sleep .01; done
}
]=])
expect_shell(0 "^130\n$" "${start}_in_folder; kill -INT $pid; sleep .1; kill -INT $pid; end")
expect_no_file(new)
expect_shell(0 "^$" "rm never.ply never.labels; { sleep .1; ${run} --output never.ply --planes /dev/stdout; } | true")
expect_no_file(never.ply never.labels)

finish()
