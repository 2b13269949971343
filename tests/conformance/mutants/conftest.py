"""A short recording for hostile programs, none of which may outlive its test."""

from tests.conformance.hostile_programs import no_process_is_left, recording

__all__ = ["no_process_is_left", "recording"]
