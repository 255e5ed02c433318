#!/usr/bin/perl
# Exercise (b), an answer. Every comparison is one that is false for NaN, as in FORTRAN; the check variable is divided first
# and multiplied by DELTA then. Perl dies when it divides by 0; line 31 of the listing sees to it that nothing does.
use strict;
use warnings;
use lib 'reference/course/exercises';    # as seen from the project's root
use calls;

my ($delta, $epsgap, $epsmul) = (1e-20, 1e-10, .390625e-02);    # the listing's DATA statement

# The share of the remaining load at which one pair has its event; 1 when it has none.
sub scale_factor {
    my ($d, $d_star, $face, $isep, $isurf) = @_;
    my $gap = $face - $d;
    return 1 if $d_star == 0;
    if (abs($gap) < $epsgap) {
        my $s_chk = $isep * $isurf / $d_star;
        return $s_chk > 0 ? $s_chk * $delta : 1;
    }
    return $gap / $d_star;
}

# SMIN of a call; ss and isep of its pairs are set. Each pair is a hash: d, d_star, face, isep, isurf.
sub contct {
    my @pairs = @_;
    my $smin = 1;
    for my $pair (@pairs) {
        $pair->{ss} = scale_factor(@$pair{qw(d d_star face isep isurf)});
        $smin = $pair->{ss} if $pair->{ss} > 0 && $pair->{ss} < $smin;
    }
    return $smin if $smin == 1;
    for my $pair (@pairs) {
        $pair->{isep} = $pair->{isep} == 1 ? -1 : 1 if abs($pair->{ss} - $smin) / $smin < $epsmul;
    }
    return $smin;
}

answer_calls(\&contct);
