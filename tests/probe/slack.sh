#!/bin/sh
# slack.sh FLAGS COMPILER..: a compiler launcher that adds flags against strict floating point.
flags=$1
shift
# shellcheck disable=SC2086 # flags are words
exec "$@" $flags
