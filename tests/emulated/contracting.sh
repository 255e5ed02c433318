#!/bin/sh
# A compiler launcher that puts a fault in: products and sums are contracted after all.
exec "$@" -ffp-contract=fast
