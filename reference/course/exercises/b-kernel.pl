#!/usr/bin/perl
# Exercise (b): CONTCT in Perl, with a hole.
#
#   cp reference/course/exercises/b-kernel.pl build/course/b.pl
#   sh reference/course/exercises/check.sh b build/course/b.pl
#
# Reading the calls and writing the answers is done, in calls.pm. Fill in the two subroutines: the listing and the paper's steps
# say how. Perl's numbers are the listing's 8-byte REAL.
use strict;
use warnings;
use lib 'reference/course/exercises';    # as seen from the project's root
use calls;

my ($delta, $epsgap, $epsmul) = (1e-20, 1e-10, .390625e-02);    # the listing's DATA statement

# The share of the remaining load at which one pair has its event; 1 when it has none.
sub scale_factor {
    my ($d, $d_star, $face, $isep, $isurf) = @_;
    return 1;    # THE HOLE: lines 30 to 39 of the listing
}

# SMIN of a call; ss and isep of its pairs are set. Each pair is a hash: d, d_star, face, isep, isurf.
sub contct {
    my @pairs = @_;
    my $smin = 1;
    for my $pair (@pairs) {
        $pair->{ss} = scale_factor(@$pair{qw(d d_star face isep isurf)});
        # THE HOLE: line 40
    }
    # THE HOLE: lines 42 to 63
    return $smin;
}

answer_calls(\&contct);
