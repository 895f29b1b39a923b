# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Completion of detect_planes in bash. The options are those of its help.

_detect_planes()
{
  local program=$1 current=$2 previous=$3
  case $previous in
    --backend)
      COMPREPLY=($(compgen -W "$("$program" --help all | sed -n 's/^ *--backend NAME *\([a-z, ]*\);.*/\1/p' | tr -d ,)" \
        -- "$current"))
      ;;
    --format)
      COMPREPLY=($(compgen -W "ply las $("$program" --help | grep -om1 '\<laz\>') pcd off ptx xyz txt csv pts pwn xyzn xyzrgb asc" \
        -- "$current"))
      ;;
    --maximum-distance)
      COMPREPLY=($(compgen -W "auto auto-local" -- "$current"))
      ;;
    --output-directory)
      mapfile -t COMPREPLY < <(compgen -d -- "$current")
      compopt -o filenames 2> /dev/null
      ;;
    *)
      COMPREPLY=()
      [[ $current != -* ]] ||
        COMPREPLY=($(compgen -W "$("$program" --help all | sed -n 's/^ *\(-[a-z] \[ \)*\(--[a-z-]*\).*/\2/p')" -- "$current"))
      ;;
  esac
}
complete -o default -F _detect_planes detect_planes
