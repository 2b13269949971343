"""Drives of the proving ground: manoeuvres, the 17 runs, and parked vehicles."""
