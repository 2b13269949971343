"""Which flaw of the catalogue a failing device resembles: probes, features and a comparison."""
