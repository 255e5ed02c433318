#!/bin/sh
# A compiler launcher that puts a fault in: floating point that is not strict after all. usage: slack.sh FLAGS COMPILER..
flags=$1
shift
# shellcheck disable=SC2086 # flags are words
exec "$@" $flags
