"""A run that is watched: interpreter, devices, result, trace, time, and two runs compared."""
