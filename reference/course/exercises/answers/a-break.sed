# Exercise (a), an answer: <= for <. The two differ only where a pair lies exactly 1/256 behind the winner. Of the golden
# set only ties.trace has such a pair; at random it would never come, and fuzz finds it because it aims at thresholds.
s/< epsmul) isep/<= epsmul) isep/
