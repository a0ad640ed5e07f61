"""Questions of PHASE in words, for lm-eval."""


def doc_to_text(doc):
    options = "\n".join(f"{chr(65 + k)}. {text}" for k, text in enumerate(doc["options"]))
    return f"{doc['introduction']}\n\n{doc['text']}\n\n{doc['question']}\n{options}\nAnswer:"


def doc_to_choice(doc):
    return [chr(65 + k) for k in range(len(doc["options"]))]
