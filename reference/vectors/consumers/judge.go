// Judges a kernel in Go: go run judge.go ../contct-vectors-1.json. Put yours in the place of contct.
// Exit status 0: equal to the bit in every call; 1: not, or nothing was compared.
package main

import (
	"encoding/json"
	"fmt"
	"math"
	"os"
	"strconv"
)

type numbers struct{ Hex []string }
type call struct {
	Call, Indof, Ndofpn               int
	Why                               string
	Dof, Id, Isep, Isurf, Isep_after  []int
	Dd, Dtest, Cc, Ss                 numbers
	Smin                              struct{ Hex string }
}
type vectors struct {
	Cases []struct {
		Name  string
		Real  int
		Calls []call
	}
}

// dd and dtest by dof. The conversions to float64 keep the compiler from contracting.
func contct(dd, dtest map[int]float64, cc []float64, id, isep, isurf []int, indof, ndofpn int) (float64, []float64) {
	const delta, epsgap, epsmul = 1e-20, 1e-10, 0.390625e-02
	smin, ss := 1.0, make([]float64, len(id))
	for i := range id {
		dof := (id[i]-1)*ndofpn + indof
		gap, response := cc[i]-dd[dof], dtest[dof]
		ss[i] = 1
		if response == 0 {
		} else if math.Abs(gap) < epsgap {
			if check := float64(isep[i]*isurf[i]) / response; check > 0 {
				ss[i] = float64(check * delta)
			}
		} else {
			ss[i] = gap / response
		}
		if ss[i] > 0 && ss[i] < smin {
			smin = ss[i]
		}
	}
	for i := range id {
		if smin != 1 && math.Abs(ss[i]-smin)/smin < epsmul {
			if isep[i] == 1 {
				isep[i] = -1
			} else {
				isep[i] = 1
			}
		}
	}
	return smin, ss
}

func double(text string) float64 {
	x, err := strconv.ParseFloat(text, 64)
	if err != nil {
		panic(err)
	}
	return x
}

func main() {
	var v vectors
	text, err := os.ReadFile(os.Args[1])
	if err == nil {
		err = json.Unmarshal(text, &v)
	}
	if err != nil {
		panic(err)
	}
	same := func(a float64, text string) bool {
		b := double(text)
		return (a != a && b != b) || math.Float64bits(a) == math.Float64bits(b)
	}
	calls, wrong := 0, 0
	for _, group := range v.Cases {
		for _, c := range group.Calls {
			if group.Real != 8 {
				continue
			}
			dd, dtest, cc := map[int]float64{}, map[int]float64{}, []float64{}
			for i, dof := range c.Dof {
				dd[dof], dtest[dof] = double(c.Dd.Hex[i]), double(c.Dtest.Hex[i])
			}
			for _, x := range c.Cc.Hex {
				cc = append(cc, double(x))
			}
			smin, ss := contct(dd, dtest, cc, c.Id, c.Isep, c.Isurf, c.Indof, c.Ndofpn)
			first := "" // the first wrong value: SS(I), SMIN or ISEP(I)
			note := func(equal bool, what string, found, expected any) {
				if !equal && first == "" {
					first = fmt.Sprintf("%s %v, expected %v", what, found, expected)
				}
			}
			for i := range ss {
				note(same(ss[i], c.Ss.Hex[i]), fmt.Sprintf("SS(%d)", i+1), ss[i], double(c.Ss.Hex[i]))
			}
			note(same(smin, c.Smin.Hex), "SMIN", smin, double(c.Smin.Hex))
			for i := range c.Isep {
				note(c.Isep[i] == c.Isep_after[i], fmt.Sprintf("ISEP(%d)", i+1), c.Isep[i], c.Isep_after[i])
			}
			if first != "" {
				if wrong == 0 {
					fmt.Printf("%s, call %d (%s): found %s\n", group.Name, c.Call, c.Why, first)
				}
				wrong++
			}
			calls++
		}
	}
	fmt.Printf("%d calls, %d differ\n", calls, wrong)
	if calls == 0 || wrong > 0 {
		os.Exit(1)
	}
}
