"""`conformance faults`: the study of faults, its list, and the count of false alarms."""
