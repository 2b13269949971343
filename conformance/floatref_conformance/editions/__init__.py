"""The editions of the judge: what each fixes, and where its limits come from."""
