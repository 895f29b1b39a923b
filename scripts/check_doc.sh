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

root=$(cd "$(dirname "$0")/.." && pwd)
TANDEM_DOC_DIR=${TANDEM_DOC_DIR:-$root/build/doc}
html=$TANDEM_DOC_DIR/html
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cd "$root/examples"
for program in Shape_regularization_tandem/*.cpp detect_planes/detect_planes.cpp python/*.py; do
  for command in "^\\\\example $program\$" "\\\\ref $program \"[^\"]*\" | ."; do
    grep -q "$command" "$root/doc/Shape_regularization_tandem/examples.txt" || fail "examples.txt does not list $program"
  done
done

cd "$root"
expected=examples/Shape_regularization_tandem/expected
patterns=$(grep -l '[*]' $expected/example_*.txt || true)
[ -z "$patterns" ] || fail "patterns in place of the output of a run: $patterns"

manual=doc/Shape_regularization_tandem
find include \( -name '*.h' -o -name '*.cu*' \) -exec sed 's|^ *// *||' {} + | tr '\n' ' ' |
  grep -o 'the manual, "[^"]*"' | sed 's/.*, "//; s/"$//' | sort -u | while read -r title; do
  grep -q "^[\\]\(page\|section\|subsection\) [^ ]* $title\$" $manual/*.txt ||
    fail "no section \"$title\", to which a comment refers"
done

# The parameters of the building, and its figures as they are printed by the program.
clouds=benchmark/Shape_regularization_tandem/clouds.csv
parameters=$(awk -F, '$1 == "building" {
  printf "--maximum-distance %s --maximum-angle %s --minimum-region-size %s", $11, $12, $13 }' $clouds)
for file in README.md scripts/demo.sh $manual/Program.txt examples/Shape_regularization_tandem/CMakeLists.txt; do
  grep -qFe "$parameters" $file || fail "$file does not have the building with $parameters"
done
figures=$(awk '/^  shapes / { shapes = $2; planes = $4; directions = $7 }
  /^  quality / { printf "%d / %d / %d | %.2f | %.1f", shapes, directions, planes, $9, $3 }' \
  $expected/example_detect_planes_of_building.txt)
for file in README.md $manual/tables/comparison.md; do
  grep -q "^| building.*Tandem.*| $figures " $file ||
    fail "$file has other figures of the building than $figures"
done
columns=$(echo "$figures" | sed 's|/|\||g')
for name in maximum_distance maximum_angle angle_tolerance minimum_region_size simplicity regularity; do
  grep -qF "| $columns " $manual/tables/$name.md || fail "$name.md has other figures of the building than $columns"
done

cat > "$folder/Shape_detection.tag" << 'END'
<?xml version='1.0' encoding='UTF-8' standalone='yes' ?>
<tagfile>
  <compound kind="class">
    <name>CGAL::Shape_detection::Efficient_RANSAC</name>
    <filename>classCGAL_1_1Shape__detection_1_1Efficient__RANSAC.html</filename>
    <templarg></templarg>
  </compound>
</tagfile>
END
cat > "$folder/Shape_regularization.tag" << 'END'
<?xml version='1.0' encoding='UTF-8' standalone='yes' ?>
<tagfile>
  <compound kind="namespace">
    <name>CGAL::Shape_regularization::Planes</name>
    <filename>namespaceCGAL_1_1Shape__regularization_1_1Planes.html</filename>
    <member kind="function">
      <type>void</type>
      <name>regularize_planes</name>
      <anchorfile>group__PkgShapeRegularizationRefPlanes.html</anchorfile>
      <anchor>a0</anchor>
      <arglist>(PlaneRange &amp;planes)</arglist>
    </member>
  </compound>
</tagfile>
END
TANDEM_CGAL_TAGS=$folder TANDEM_DOC_DIR=$folder "$root/scripts/doc.sh"
for link in Shape_detection/classCGAL_1_1Shape__detection_1_1Efficient__RANSAC.html \
  Shape_regularization/group__PkgShapeRegularizationRefPlanes.html; do
  grep -q "<a [^>]*href=\"https://doc.cgal.org/latest/$link" "$folder/html/Tandem_models.html" || fail "no link to $link"
done

TANDEM_DOC_DIR=$TANDEM_DOC_DIR TANDEM_CGAL_TAGS='' "$root/scripts/doc.sh"
! grep -rq 'href="https://doc.cgal.org' "$html" || fail "links to CGAL's manual without a tag file"
for name in detect_planes maximum_distance Planar_shapes_3 Guarantees; do
  grep -q "\['$name'," "$html"/search/all_*.js || fail "the search does not know $name"
done
"$root/scripts/check_links.py" "$html" || fail "links are broken"
