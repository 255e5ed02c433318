# The calls of CONTCT that come over a pipe, and their answers, for kernels in Perl: see reference/trace-format.md.
package calls;
use strict;
use warnings;
use Exporter qw(import);
use POSIX qw(strtod);
our @EXPORT = qw(answer_calls);

# Ask `contct` at each call. It gets the call's pairs, each a hash with d, d_star, face, isep and isurf, sets ss and isep of
# them, and returns SMIN.
sub answer_calls {
    my ($contct) = @_;
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
            my $smin = $contct->(@pairs);
            print "smin ", hexfloat($smin), "\n";
            print "pair ", $_ + 1, " ss ", hexfloat($pairs[$_]{ss}), " isep $pairs[$_]{isep}\n" for 0 .. $#pairs;
            print "end\n";
        }
    }
}

sub real { my ($number) = strtod($_[0]); return $number }

sub hexfloat {
    my ($number) = @_;
    return 'nan' if $number != $number;
    return sprintf '%a', $number unless abs($number) == 9**9**9;
    return $number > 0 ? 'inf' : '-inf';
}

1;
