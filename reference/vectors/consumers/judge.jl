# Judges a kernel in Julia: julia judge.jl ../contct-vectors-1.txt. Put yours in the place of contct.
# Exit status 0: equal to the bit in every call; 1: not, or nothing was compared.
const DELTA, EPSGAP, EPSMUL = 1e-20, 1e-10, 0.390625e-02

function contct(d, response, face, isep, isurf)
    function scale_factor(d, response, face, isep, isurf)
        gap = face - d
        response == 0 && return 1.0
        abs(gap) < EPSGAP || return gap / response
        check = isep * isurf / response
        check > 0 ? check * DELTA : 1.0
    end
    ss = Float64[scale_factor(pair...) for pair in zip(d, response, face, isep, isurf)]
    smin = foldl((least, s) -> 0 < s < least ? s : least, ss; init = 1.0)
    toggled(s) = smin != 1 && abs(s - smin) / smin < EPSMUL
    smin, ss, Int[toggled(s) ? (status == 1 ? -1 : 1) : status for (s, status) in zip(ss, isep)]
end

real(word) = parse(Float64, word)
whole(word) = parse(Int, word)
same(a, b) = (isnan(a) && isnan(b)) || reinterpret(Int64, a) == reinterpret(Int64, b)

function judge(lines)
    calls, wrong, at = 0, 0, 2
    while at <= length(lines)
        head = lines[at]
        call, bytes, indof, ndofpn, _, used, nc = whole.(head[3:9])
        dofs = Dict(whole(w[1]) => (real(w[2]), real(w[3])) for w in lines[at+1:at+used])
        rows = lines[at+used+1:at+used+nc]
        at += 1 + used + nc
        bytes == 8 || continue
        here = [dofs[(whole(w[1]) - 1) * ndofpn + indof] for w in rows]
        column(kind, i) = [kind(w[i]) for w in rows]
        smin, ss, isep = contct(first.(here), last.(here), column(real, 4), column(whole, 2), column(whole, 3))
        names = ["SS(" .* string.(1:nc) .* ")"; "SMIN"; "ISEP(" .* string.(1:nc) .* ")"]
        found, expected = Real[ss; smin; isep], Real[column(real, 5); real(head[10]); column(whole, 6)]
        k = findfirst(i -> !same(found[i], expected[i]), eachindex(names))
        if k !== nothing
            wrong == 0 && println("$(head[2]), call $call: found $(names[k]) $(found[k]), expected $(expected[k])")
            wrong += 1
        end
        calls += 1
    end
    println("$calls calls, $wrong differ")
    calls == 0 || wrong > 0
end
exit(judge(split.(readlines(ARGS[1]), ' ')))
