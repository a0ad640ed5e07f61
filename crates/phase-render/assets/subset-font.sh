#!/bin/sh
# Makes DejaVuSans-subset.ttf from DejaVu Sans 2.37 (https://dejavu-fonts.github.io/), given as the argument,
# with pyftsubset of fonttools: printable ASCII, Latin-1, Greek, sub- and superscript digits, dashes, arrows and
# the mathematical symbols that captions use; without hinting, since glyphs are drawn from their outlines.
set -eu
pyftsubset "$1" --output-file="$(dirname "$0")/DejaVuSans-subset.ttf" \
    --unicodes="U+20-7E,U+A0-FF,U+391-3A1,U+3A3-3A9,U+3B1-3C9,U+2007,U+2009,U+2010-2015,U+2018-201D,U+2022,U+2026,U+2032,U+2070,U+2074-2079,U+2080-2089,U+2190-2195,U+2208,U+2212,U+221E,U+2248,U+2260,U+2264,U+2265" \
    --layout-features='' --no-hinting --notdef-outline --name-IDs='0,1,2,3,4,5,6,13,14' \
    --drop-tables+=GSUB,GPOS,GDEF,kern,DSIG,FFTM,MATH,gasp
