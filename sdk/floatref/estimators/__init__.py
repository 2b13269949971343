"""Estimators in place of both integrations, and levelling; each with its kernels."""
