#!/usr/bin/env bash
# Puts the radar shape of (99942) Apophis beside the model.
#
# The shape is that of Brozovic et al., Icarus 300 (2018) 115: 2000 vertices, 3996 triangles, in kilometres. It is not
# ours to give away; A. Quillen keeps a copy as an OBJ file at https://github.com/aquillen/Apophis. Fetch it from there
# and give its path:
#
#     ./get-shape.sh PATH-OF-THE-OBJ-FILE
set -euo pipefail
folder=$(dirname "${BASH_SOURCE[0]}")
if [ $# -ne 1 ]; then
    sed -n '2,9p' "${BASH_SOURCE[0]}" >&2
    exit 2
fi
expected=0d6f96a7a4d511d140498514b9b18adad140a162c71db5e644794a6cbf2d4fbc
found=$(sha256sum "$1" | cut -d' ' -f1)
if [ "$found" != "$expected" ]; then
    echo "get-shape.sh: $1 has the checksum $found, the example was made with $expected; going on with yours" >&2
fi
cp "$1" "$folder/apophis-radar-shape.obj"
