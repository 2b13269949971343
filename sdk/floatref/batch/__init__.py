"""Many recordings at once: one file is one task on a Dask cluster, with one row or more each.

A task reads its own input and writes its own profile and record under a temporary name, then
renames them, so that it may run again at any time. The summary is made of the records.
"""

from floatref.batch.jobs.job import Job

__all__ = ["Job"]
