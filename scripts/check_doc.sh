#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Checks the manual: all examples are listed with a description; it has the sections to which comments of the headers
# refer; it builds without a warning; its search knows the names of the package; names of CGAL are links where there is a
# tag file, and plain text where there is none; its links lead to pages and anchors that are there; the outputs of examples
# are those of a run; and the figures of the building are the same everywhere.
#   TANDEM_DOC_DIR    where the manual is built (default: build/doc of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

fail() { echo "check_doc.sh: $*" >&2; exit 1; }

cd "$(dirname "$0")/.."
html=${TANDEM_DOC_DIR:-build/doc}/html
manual=doc/Shape_regularization_tandem
expected=examples/Shape_regularization_tandem/expected

for name in $(cd examples && ls Shape_regularization_tandem/*.cpp detect_planes/detect_planes.cpp python/*.py); do
  for command in "^\\\\example $name\$" "\\\\ref $name \"[^\"]*\" | ."; do
    grep -q "$command" $manual/examples.txt || fail "examples.txt does not list $name"
  done
done
! grep -l '[*]' $expected/example_*.txt || fail "these have patterns in place of the output of a run"
find include \( -name '*.h' -o -name '*.cu*' \) -exec sed 's|^ *// *||' {} + | tr '\n' ' ' |
  grep -o 'the manual, "[^"]*"' | sed 's/.*, "//; s/"$//' | sort -u | while read -r title; do
  grep -q "^[\\]\(page\|section\|subsection\) [^ ]* $title\$" $manual/*.txt ||
    fail "no section \"$title\", to which a comment refers"
done

# The parameters of the building, and its figures as they are printed by the program.
parameters=$(awk -F, '$1 == "building" {
  printf "--maximum-distance %s --maximum-angle %s --minimum-region-size %s", $11, $12, $13 }' \
  benchmark/Shape_regularization_tandem/clouds.csv)
for file in README.md scripts/demo.sh $manual/Program.txt examples/Shape_regularization_tandem/CMakeLists.txt; do
  grep -qFe "$parameters" "$file" || fail "$file does not have the building with $parameters"
done
figures=$(awk '/^  shapes / { shapes = $2; planes = $4; directions = $7 }
  /^  quality / { printf "%d / %d / %d | %.2f | %.1f", shapes, directions, planes, $9, $3 }' \
  $expected/example_detect_planes_of_building.txt)
grep -q "^| building.*Tandem.*| $figures " $manual/tables/comparison.md ||
  fail "comparison.md has other figures of the building than $figures"
row=$(echo "$figures" | awk '{ printf "%s | %s | %s | %s %% | 0", $1, $5, $3, $9 }')
grep -q '^| a building, 100,000 .*| shapes | planes | directions | points in a shape | points out of tolerance |$' README.md &&
  grep -q "^| [*][*]Tandem[*][*] |.*| $row |$" README.md || fail "README.md has other figures of the building than $row"
columns=$(echo "$figures" | sed 's|/|\||g')
for name in maximum_distance maximum_angle angle_tolerance minimum_region_size simplicity regularity; do
  grep -qF "| $columns " $manual/tables/$name.md || fail "$name.md has other figures of the building than $columns"
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/Shape_detection.tag" << 'END'
<tagfile><compound kind="class"><name>CGAL::Shape_detection::Efficient_RANSAC</name><filename>Ransac.html</filename>
<templarg></templarg></compound></tagfile>
END
cat > "$folder/Shape_regularization.tag" << 'END'
<tagfile><compound kind="namespace"><name>CGAL::Shape_regularization::Planes</name><filename>Planes.html</filename>
<member kind="function"><type>void</type><name>regularize_planes</name><anchorfile>Regularize.html</anchorfile>
<anchor>a0</anchor><arglist>(PlaneRange &amp;planes)</arglist></member></compound></tagfile>
END
TANDEM_CGAL_TAGS=$folder TANDEM_DOC_DIR=$folder scripts/doc.sh
for link in Shape_detection/Ransac.html Shape_regularization/Regularize.html; do
  grep -q "<a [^>]*href=\"https://doc.cgal.org/latest/$link" "$folder/html/Tandem_models.html" || fail "no link to $link"
done

TANDEM_CGAL_TAGS='' scripts/doc.sh
! grep -rq 'href="https://doc.cgal.org' "$html" || fail "links to CGAL's manual without a tag file"
for name in detect_planes maximum_distance Planar_shapes_3 Guarantees; do
  grep -q "\['$name'," "$html"/search/all_*.js || fail "the search does not know $name"
done
# Each link to a page or an anchor, but not to other sites, has to be the name of one.
python3 - "$html" << 'END' || fail "links are broken"
import pathlib, re, sys, urllib.parse
pages = {p.resolve(): p.read_text(errors="replace") for p in pathlib.Path(sys.argv[1]).rglob("*.html")}
anchors = {page: set(re.findall(r'<[^>]* (?:id|name)="([^"]+)"', text)) for page, text in pages.items()}
broken = [] if pages else ["no pages"]
for page, text in pages.items():
    for link in re.findall(r'<[^>]* (?:href|src)="([^"]+)"', text):
        name, _, anchor = urllib.parse.unquote(link.replace("&amp;", "&")).partition("#")
        target = (page.parent / name.split("?")[0]).resolve() if name else page
        if not re.match(r"\w+:|//", name) and not (target.exists() and (not anchor or anchor in anchors.get(target, [anchor]))):
            broken.append(f"{page}: {link}")
sys.exit("\n".join(broken) or 0)
END
