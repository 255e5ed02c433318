"""Mistakes that mypy finds, since contct.py is typed."""
import contct

contct.run(3)
contct.run("beam.toml", engin="updated")
status: int = contct.run("beam.toml").status
share: float = contct.exact("beam.toml").steps[0].fraction
contct.judge(lambda call: call.dd)
