"""`conformance certify`: the judgement of a profiler from recorded runs, and its options."""
