// Judges a kernel in JavaScript: node judge.js ../contct-vectors-1.json. Put yours in the place of `contct`.
// Exit status 0: equal to the bit in every call; 1: not; 2: nothing was compared.
const DELTA = 1e-20, EPSGAP = 1e-10, EPSMUL = 0.390625e-02;

function contct(dd, dtest, cc, id, isep, isurf, indof, ndofpn) {
  const ss = id.map((node, i) => {
    const dof = (node - 1) * ndofpn + indof, gap = cc[i] - dd.get(dof), response = dtest.get(dof);
    if (response === 0) return 1;
    if (!(Math.abs(gap) < EPSGAP)) return gap / response;
    const check = isep[i] * isurf[i] / response;
    return check > 0 ? check * DELTA : 1;
  });
  const smin = ss.reduce((least, s) => s > 0 && s < least ? s : least, 1);
  const toggled = s => smin !== 1 && Math.abs(s - smin) / smin < EPSMUL;
  return {smin, ss, isep: isep.map((status, i) => !toggled(ss[i]) ? status : status === 1 ? -1 : 1)};
}

const doubles = values => values.decimal.map(Number); // "NaN", "Infinity" and "-Infinity" are texts; -0.0 stays -0
const vectors = JSON.parse(require("fs").readFileSync(process.argv[2], "utf8"));
let calls = 0, wrong = 0;
for (const group of vectors.cases.filter(c => c.real === 8))
  for (const call of group.calls) {
    const by_dof = values => new Map(doubles(values).map((x, i) => [call.dof[i], x]));
    const found = contct(by_dof(call.dd), by_dof(call.dtest), doubles(call.cc), call.id, call.isep, call.isurf, call.indof, call.ndofpn);
    const named = (key, values) => values.map((x, i) => [`${key}(${i + 1})`, x]);
    const all = (smin, ss, isep) => [...named("SS", ss), ["SMIN", smin], ...named("ISEP", isep)];
    const expected = new Map(all(Number(call.smin.decimal), doubles(call.ss), call.isep_after));
    const answer = new Map(all(found.smin, found.ss, found.isep));
    const first = [...expected.keys()].find(key => !Object.is(answer.get(key), expected.get(key)));
    const shown = x => Object.is(x, -0) ? "-0" : x; // a text would lose the sign
    if (first && wrong++ === 0)
      console.log(`${group.name}, call ${call.call} (${call.why}): found ${first} ${shown(answer.get(first))}, expected ${shown(expected.get(first))}`);
    ++calls;
  }
console.log(`${calls} calls, ${wrong} differ`);
process.exitCode = calls === 0 ? 2 : wrong > 0 ? 1 : 0;
