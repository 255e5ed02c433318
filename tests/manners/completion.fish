# completion.fish PROGRAM: what fish offers, in a real fish.
source (command $argv[1] completion fish | psub)
set failures 0

function expect --no-scope-shadowing
    set -l got (complete -C $argv[1] | string split -f 1 \t | sort | string join ' ')
    if test "$got" != "$argv[2]"
        echo "for \"$argv[1]\": offered \"$got\"; wanted \"$argv[2]\"" >&2
        set failures (math $failures + 1)
    end
end

expect 'contct r' 'replay run'
expect 'contct run --ker' --kernels
expect 'contct explain --inc' --increment
expect 'contct run --engine re' refactor
expect 'contct run --engine a' auto
expect 'contct completion ' 'bash fish zsh'
expect 'contct new b' beam
test $failures = 0
