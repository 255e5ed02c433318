// Judges a kernel in Rust: rustc -O -o judge judge.rs && ./judge ../contct-vectors-1.txt. Put yours in the place of `contct`.
// Exit status 0: equal to the bit in every call; 1: not; 2: nothing was compared, or the file is cut short.

/// A pair: d, d*, face, ISEP, ISURF. The answer: SMIN, SS, ISEP.
fn contct(pairs: &[(f64, f64, f64, i64, i64)]) -> (f64, Vec<f64>, Vec<i64>) {
    const DELTA: f64 = 1e-20;
    const EPSGAP: f64 = 1e-10;
    const EPSMUL: f64 = 0.390625e-02;
    let scale_factor = |&(d, response, face, isep, isurf): &(f64, f64, f64, i64, i64)| {
        let gap = face - d;
        if response == 0.0 { return 1.0; }
        if gap.abs() >= EPSGAP || gap.is_nan() { return gap / response; }
        let check = (isep * isurf) as f64 / response;
        if check > 0.0 { check * DELTA } else { 1.0 }
    };
    let ss: Vec<f64> = pairs.iter().map(scale_factor).collect();
    let smin = ss.iter().fold(1.0, |least, &s| if s > 0.0 && s < least { s } else { least });
    let toggled = |s: f64| smin != 1.0 && (s - smin).abs() / smin < EPSMUL;
    let after = |(pair, &s): (&(f64, f64, f64, i64, i64), &f64)| if !toggled(s) { pair.3 } else if pair.3 == 1 { -1 } else { 1 };
    let isep = pairs.iter().zip(&ss).map(after).collect();
    (smin, ss, isep)
}

fn same(a: f64, b: f64) -> bool { (a.is_nan() && b.is_nan()) || a.to_bits() == b.to_bits() }

fn main() {
    let text = std::fs::read_to_string(std::env::args().nth(1).expect("the file of vectors")).expect("a file that can be read");
    let mut lines = text.lines().map(|line| line.split(' ').collect::<Vec<_>>());
    let announced: usize = lines.next().expect("a header")[2].parse().expect("the number of calls");
    let (real, whole) = (|w: &str| w.parse::<f64>().expect("a number"), |w: &str| w.parse::<i64>().expect("a whole number"));
    let (mut seen, mut calls, mut wrong) = (0, 0, 0);
    while let Some(head) = lines.next() {
        let n: Vec<i64> = head[2..9].iter().map(|w| whole(w)).collect(); // call, real, indof, ndofpn, dofs, used, nc
        let dofs: std::collections::HashMap<i64, (f64, f64)> =
            lines.by_ref().take(n[5] as usize).map(|w| (whole(w[0]), (real(w[1]), real(w[2])))).collect();
        let rows: Vec<Vec<&str>> = lines.by_ref().take(n[6] as usize).collect();
        let at = |w: &Vec<&str>| dofs[&((whole(w[0]) - 1) * n[3] + n[2])];
        let pairs: Vec<_> = rows.iter().map(|w| (at(w).0, at(w).1, real(w[3]), whole(w[1]), whole(w[2]))).collect();
        seen += 1;
        if n[1] != 8 { continue; }
        let (smin, ss, isep) = contct(&pairs);
        let of_ss = |i: usize| (!same(ss[i], real(rows[i][4]))).then(|| format!("SS({}) {:?}, expected {}", i + 1, ss[i], rows[i][4]));
        let of_smin = || (!same(smin, real(head[9]))).then(|| format!("SMIN {:?}, expected {}", smin, head[9]));
        let of_isep = |i: usize| (isep[i] != whole(rows[i][5])).then(|| format!("ISEP({}) {}, expected {}", i + 1, isep[i], rows[i][5]));
        let first = (0..rows.len()).find_map(of_ss).or_else(of_smin).or_else(|| (0..rows.len()).find_map(of_isep));
        if let (Some(words), 0) = (&first, wrong) { println!("{}, call {}: found {}", head[1], n[0], words); }
        wrong += i32::from(first.is_some());
        calls += 1;
    }
    println!("{calls} calls, {wrong} differ");
    std::process::exit(if calls == 0 || seen != announced { 2 } else { i32::from(wrong > 0) });
}
