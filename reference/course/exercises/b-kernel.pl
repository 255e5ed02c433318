#!/usr/bin/perl
# Exercise (b): CONTCT in Perl, with a hole.
#
#   cp reference/course/exercises/b-kernel.pl build/course/b.pl
#   sh reference/course/exercises/check.sh b build/course/b.pl
#
# Reading the calls and writing the answers is done. Fill in the two subroutines; reference/trace-format.md says what comes
# over the pipe, the listing and the paper's steps say what to do with it. Perl's numbers are the listing's 8-byte REAL.
use strict;
use warnings;
use POSIX qw(strtod);

my ($delta, $epsgap, $epsmul) = (1e-20, 1e-10, .390625e-02);    # the listing's DATA statement

# The share of the remaining load at which one pair has its event; 1 when it has none.
sub scale_factor {
    my ($d, $d_star, $face, $isep, $isurf) = @_;
    return 1;    # THE HOLE: lines 30 to 39 of the listing
}

# SMIN of a call; ss and isep of its pairs are set. Each pair is a hash: d, d_star, face, isep, isurf; ss is yours to set.
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

$| = 1;    # an answer goes out at once: without this both sides wait for ever
my ($indof, $ndofpn, %dofs, @pairs);
while (my $line = <STDIN>) {
    my @words = split ' ', $line;
    my $key = @words ? $words[0] : '';
    if ($key eq 'indof') {    # indof I ndofpn N dofs M nc K: a call begins
        ($indof, $ndofpn) = @words[1, 3];
        %dofs = @pairs = ();
    } elsif ($key eq 'dof') {    # dof N dd X dtest X: only those that a pair looks at
        $dofs{$words[1]} = [real($words[3]), real($words[5])];
    } elsif ($key eq 'pair') {    # pair N id N isep S isurf S cc X
        my ($d, $d_star) = @{$dofs{($words[3] - 1) * $ndofpn + $indof}};
        push @pairs, {d => $d, d_star => $d_star, face => real($words[9]), isep => $words[5], isurf => $words[7]};
    } elsif ($key eq 'ask') {
        my $smin = contct(@pairs);
        print "smin ", hexfloat($smin), "\n";
        print "pair ", $_ + 1, " ss ", hexfloat($pairs[$_]{ss}), " isep $pairs[$_]{isep}\n" for 0 .. $#pairs;
        print "end\n";
    }
}

sub real { my ($number) = strtod($_[0]); return $number }

sub hexfloat {
    my ($number) = @_;
    return 'nan' if $number != $number;
    return sprintf '%a', $number unless abs($number) == 9**9**9;
    return $number > 0 ? 'inf' : '-inf';
}
